/** What is sent, and how far that is. */
export interface UploadProgress {
  readonly sentBytes: number;
  readonly totalBytes: number;
  readonly file: string;
}

/** Why the server, or the network, did not take an upload: a sentence. */
export class UploadError extends Error {}

const kPath = "/v1/uploads";

/** Of one upload; long enough that nobody guesses it. */
export function newToken(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (b) => b.toString(16).padStart(2, "0")).join("");
}

interface Answer {
  readonly status: number;
  readonly text: string;
}

/** XMLHttpRequest and not fetch: the latter does not tell how much was sent. */
function request(
  access: string,
  method: string,
  path: string,
  body: File | undefined,
  signal: AbortSignal,
  sent?: (bytes: number) => void,
): Promise<Answer> {
  return new Promise((resolve, reject) => {
    const http = new XMLHttpRequest();
    const abort = (): void => http.abort();
    http.open(method, path);
    if (access) http.setRequestHeader("Authorization", `Bearer ${access}`);
    http.upload.onprogress = (event) => sent?.(event.loaded);
    http.onload = () => resolve({ status: http.status, text: http.responseText.trim() });
    http.onerror = () => reject(new UploadError("the connection was lost"));
    http.onabort = () => reject(new UploadError("cancelled"));
    http.onloadend = () => signal.removeEventListener("abort", abort);
    if (signal.aborted) {
      reject(new UploadError("cancelled"));
      return;
    }
    signal.addEventListener("abort", abort);
    http.send(body ?? null);
  });
}

async function succeeded(answer: Promise<Answer>): Promise<string> {
  const { status, text } = await answer;
  if (status >= 200 && status < 300) return text;
  throw new UploadError(text || `the server answered ${status}`);
}

/**
 * Sends files that belong together; returns the ids of the datasets that the server finds in them.
 * Where it fails or is aborted nothing is left on the server. `access`: an access token, or nothing.
 */
export async function sendUpload(
  access: string,
  name: string,
  files: readonly File[],
  signal: AbortSignal,
  progressed: (progress: UploadProgress) => void,
): Promise<readonly string[]> {
  const upload = `${kPath}/${newToken()}`;
  const totalBytes = files.reduce((sum, file) => sum + file.size, 0);
  let before = 0;
  try {
    for (const file of files) {
      const tell = (bytes: number): void =>
        progressed({ sentBytes: before + bytes, totalBytes, file: file.name });
      tell(0);
      const path = `${upload}/${encodeURIComponent(file.name)}`;
      await succeeded(request(access, "PUT", path, file, signal, tell));
      before += file.size;
    }
    const path = `${upload}?name=${encodeURIComponent(name)}`;
    const { datasets } = JSON.parse(
      await succeeded(request(access, "POST", path, undefined, signal)),
    );
    return datasets;
  } catch (error) {
    void request(access, "DELETE", upload, undefined, new AbortController().signal).catch(
      () => undefined,
    );
    throw error;
  }
}
