/** Offers a file to the person, by the browser's own download. */
export function saveFile(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** "volcast-Demo_mesh-2024-05-01T10-20-30.png" */
export function fileNameOf(subject: string, end: string): string {
  const plain = subject.replace(/[^\w.-]+/g, "_");
  const time = new Date().toISOString().slice(0, 19).replace(/:/g, "-");
  return `volcast-${plain}-${time}.${end}`;
}
