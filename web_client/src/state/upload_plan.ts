import { formatBytes } from "../ui/format";

/** A file that somebody wants to upload; */
export interface PlannedFile {
  readonly name: string;
  readonly size: number;
}

export interface UploadLimits {
  readonly maxBytes: number;
  readonly maxFiles: number;
}

/** Files that are no data: those that systems leave in folders. */
const kNoData = /^(\.|Thumbs\.db$|desktop\.ini$)/i;

export const isData = (name: string): boolean => !kNoData.test(name);

const kMostName = 200;

/** What an upload is called: the folder that was dropped, what all names begin with, or the first. */
export function uploadName(files: readonly PlannedFile[], folder?: string): string {
  const stems = files.map(({ name }) => name.replace(/(\.nii)?\.[^.]*$/i, "") || name);
  const first = stems[0] ?? "data";
  let common = first;
  for (const stem of stems) while (!stem.startsWith(common)) common = common.slice(0, -1);
  const shared = common.replace(/[\s._-]*\d*$/, "").replace(/[\s._-]+$/, "");
  const name = folder || (stems.every((s) => s === first) ? first : shared || first);
  const allowed = name.replace(/[/\\\p{Cc}]/gu, "_").replace(/^\.+/, "");
  return allowed.slice(0, kMostName / 2) || "data";
}

/** Why these files cannot be sent; undefined where nothing is known against it. */
export function uploadProblem(
  files: readonly PlannedFile[],
  limits: UploadLimits,
): string | undefined {
  if (files.length === 0) return "there is no file in it";
  if (files.length > limits.maxFiles) {
    return `${files.length} files; this server takes ${limits.maxFiles} at once`;
  }
  const names = new Set<string>();
  for (const { name, size } of files) {
    if (size === 0) return `${name} is empty`;
    if (names.has(name)) return `there are two files called ${name}`;
    if (new TextEncoder().encode(name).length > kMostName) return `the name ${name} is too long`;
    names.add(name);
  }
  const bytes = files.reduce((sum, { size }) => sum + size, 0);
  if (bytes <= limits.maxBytes) return undefined;
  return `${formatBytes(bytes)}; this server takes ${formatBytes(limits.maxBytes)} at once`;
}
