/** Files that are being sent, or why they were not taken. */
export interface Upload {
  readonly name: string;
  readonly sentBytes: number;
  readonly totalBytes: number;
  /** The one that is being sent. */
  readonly file: string;
  /** Where it ended without success: a sentence. */
  readonly error?: string | undefined;
  readonly cancel: () => void;
}

export const isUnderWay = (upload: Upload | undefined): boolean =>
  upload !== undefined && upload.error === undefined;
