import { sendUpload, UploadError } from "../net/uploads";
import type { AppState } from "./app_state";
import { isUnderWay, type Upload } from "./upload";
import { isData, uploadName, uploadProblem } from "./upload_plan";

/** Sends files, one upload at a time; `done` gets the datasets in them. */
export async function upload(
  state: Pick<AppState, "welcome" | "upload">,
  access: string,
  files: readonly File[],
  folder: string | undefined,
  done: (datasets: readonly string[]) => void,
): Promise<void> {
  const limits = state.welcome.value?.uploads;
  if (!limits || isUnderWay(state.upload.value)) return;
  const data = files.filter((file) => isData(file.name));
  const aborted = new AbortController();
  const name = uploadName(data, folder);
  const totalBytes = data.reduce((sum, file) => sum + file.size, 0);
  const begun: Upload = {
    name,
    sentBytes: 0,
    totalBytes,
    file: data[0]?.name ?? "",
    cancel: () => aborted.abort(),
  };
  const { maxBytes, maxFiles } = limits;
  const problem = uploadProblem(data, { maxBytes: Number(maxBytes), maxFiles });
  state.upload.value = { ...begun, error: problem };
  if (problem) return;
  try {
    const datasets = await sendUpload(access, name, data, aborted.signal, (progress) => {
      state.upload.value = { ...begun, ...progress };
    });
    state.upload.value = undefined;
    done(datasets);
  } catch (error) {
    const reason = error instanceof UploadError ? error.message : String(error);
    state.upload.value = aborted.signal.aborted ? undefined : { ...begun, error: reason };
  }
}
