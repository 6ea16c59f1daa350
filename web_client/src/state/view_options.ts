import { effect, type Signal } from "@preact/signals";

/** How a person likes to look at things: of the browser, not of a scene. */
export interface ViewOptions {
  readonly trackball: boolean;
  readonly axes: boolean;
  readonly scaleBar: boolean;
  readonly box: boolean;
  readonly legend: boolean;
  readonly hud: boolean;
  /** Ray models are shown by what they make of the data. */
  readonly thumbnails: boolean;
  /** Clip planes have handles in the picture. */
  readonly handles: boolean;
  /** Error against time is measured when nothing else happens; it keeps the server's GPU busy, so one asks for it. */
  readonly measureIdle: boolean;
}

export type ViewOption = keyof ViewOptions;

export const kUsualOptions: ViewOptions = {
  trackball: false,
  axes: true,
  scaleBar: true,
  box: false,
  legend: true,
  hud: false,
  thumbnails: false,
  handles: true,
  measureIdle: false,
};

const kKey = "volcast.options";

/** Reads what was kept; anything that is missing or odd is as usual. */
export function readOptions(text: string | null): ViewOptions {
  let kept: Partial<Record<string, unknown>> = {};
  try {
    const raw: unknown = JSON.parse(text ?? "{}");
    if (raw && typeof raw === "object") kept = raw as typeof kept;
  } catch {
    // Not ours: as usual.
  }
  const entries = Object.entries(kUsualOptions).map(([name, usual]) => {
    const value = kept[name];
    return [name, typeof value === "boolean" ? value : usual];
  });
  return Object.fromEntries(entries) as unknown as ViewOptions;
}

export function switched(options: ViewOptions, name: ViewOption): ViewOptions {
  return { ...options, [name]: !options[name] };
}

/** Takes over what this browser kept, and keeps every change; returns its end. */
export function keepOptions(options: Signal<ViewOptions>): () => void {
  options.value = readOptions(localStorage.getItem(kKey));
  return effect(() => localStorage.setItem(kKey, JSON.stringify(options.value)));
}
