/** What was dropped: files, and the name of the folder that they were in, if there was one. */
export interface Dropped {
  readonly files: readonly File[];
  readonly folder: string | undefined;
}

/** More are counted by the server, which refuses them by name. */
const kMostFiles = 20_000;

function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  return new Promise((resolve, reject) => {
    // A reader gives some at a time, and nothing at the end.
    const next = (): void =>
      reader.readEntries((some) => {
        all.push(...some);
        if (some.length === 0 || all.length > kMostFiles) resolve(all);
        else next();
      }, reject);
    next();
  });
}

const fileOf = (entry: FileSystemFileEntry): Promise<File> =>
  new Promise((resolve, reject) => entry.file(resolve, reject));

/** Reads a drop; of a folder the files that lie in it, but no folders within. */
export async function droppedFiles(transfer: DataTransfer): Promise<Dropped> {
  // Taken at once: after the event the list is empty.
  const entries = [...transfer.items]
    .map((item) => item.webkitGetAsEntry())
    .filter((entry) => entry !== null);
  const plain = [...transfer.files];
  const folders = entries.filter((e) => e.isDirectory) as FileSystemDirectoryEntry[];
  const within = await Promise.all(folders.map(entriesOf));
  const inFolders = within.flat().filter((e) => e.isFile) as FileSystemFileEntry[];
  const loose = folders.length > 0 ? entries.filter((e) => e.isFile) : [];
  const read = await Promise.all([...inFolders, ...(loose as FileSystemFileEntry[])].map(fileOf));
  return {
    files: folders.length > 0 ? read : plain,
    folder: folders.length === 1 ? folders[0]?.name : undefined,
  };
}
