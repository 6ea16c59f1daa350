const kKey = "volcast.person";

/** The name that others see, kept by the browser; empty: the server chooses one. */
export const myName = (): string => localStorage.getItem(kKey) ?? "";

export function keepMyName(name: string): void {
  localStorage.setItem(kKey, name);
}
