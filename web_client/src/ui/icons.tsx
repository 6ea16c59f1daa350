const kPaths = {
  reset: "M4 10a6 6 0 1 1 2 4.5M4 10l-1.6-2.2M4 10l2.4-1.5",
  perspective: "M3 5l14-2v14L3 15zM10 4v12M3 10h14",
  orthographic: "M3.5 3.5h13v13h-13zM10 3.5v13M3.5 10h13",
  camera: "M3 6.5h3l1.4-2h5.2l1.4 2h3v9.5H3zM10 13.6a2.7 2.7 0 1 0 0-5.4 2.7 2.7 0 0 0 0 5.4z",
  fullscreen: "M3.5 7.5v-4h4M12.5 3.5h4v4M16.5 12.5v4h-4M7.5 16.5h-4v-4",
  view: "M10 11.5V3.5M10 11.5l-6.5 4M10 11.5l6.5 4M8.2 5.2L10 3.4l1.8 1.8",
  help: "M7.4 7.4a2.7 2.7 0 1 1 3.8 2.5c-.8.4-1.2.9-1.2 1.8M10 14.6v.1",
  undo: "M7 4L3.5 7.5 7 11M3.8 7.5h7.7a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 4l3.5 3.5L13 11M16.2 7.5H8.5a4.5 4.5 0 0 0 0 9H12",
  add: "M10 4.5v11M4.5 10h11",
  remove: "M4.5 6h11M8 6V4.2h4V6M6 6l.7 10h6.6L14 6",
  close: "M5.5 5.5l9 9M14.5 5.5l-9 9",
  flip: "M10 3v14M7.5 6L3 14h4.5zM12.5 6L17 14h-4.5z",
  up: "M5 12.5l5-5 5 5",
  down: "M5 7.5l5 5 5-5",
  beside: "M3 4h14v12H3zM10 4v12M13.5 8v4M11.5 10h4",
  people:
    "M7.5 9.5a2.7 2.7 0 1 0 0-5.4 2.7 2.7 0 0 0 0 5.4zM2.5 16c0-3 2-4.5 5-4.5s5 1.5 5 4.5M13 4.3a2.7 2.7 0 0 1 0 5M14.5 11.8c2 .5 3 1.9 3 4.2",
  play: "M6.5 4l9 6-9 6z",
  pause: "M7 4.5v11M13 4.5v11",
  box: "M3.5 6.5L10 3l6.5 3.5v7L10 17l-6.5-3.5zM3.5 6.5L10 10l6.5-3.5M10 10v7",
  warning: "M10 3.2L17.5 16.5h-15zM10 8.2v4M10 14.3v.1",
} as const;

export type IconName = keyof typeof kPaths;

/** A drawing beside or instead of a label; always hidden from assistive technology. */
export function Icon({ name }: { readonly name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 20 20" aria-hidden="true" focusable="false">
      <path d={kPaths[name]} />
    </svg>
  );
}

interface IconButtonProps {
  readonly icon: IconName;
  readonly label: string;
  readonly onClick: () => void;
  readonly disabled?: boolean;
  /** Why nothing happens when it is used, as a sentence: it can be reached, and says so. */
  readonly held?: string | undefined;
  readonly shortcut?: string;
}

/** A square button whose name is shown when it is pointed at. */
export function IconButton(props: IconButtonProps) {
  const { icon, label, onClick, disabled, held, shortcut } = props;
  const name = shortcut ? `${label} (${shortcut})` : label;
  return (
    <button
      type="button"
      class="icon-button"
      aria-label={label}
      aria-keyshortcuts={shortcut}
      aria-disabled={held !== undefined ? "true" : undefined}
      title={held !== undefined ? `${name}. ${held}` : name}
      disabled={disabled && held === undefined}
      onClick={held === undefined ? onClick : undefined}
    >
      <Icon name={icon} />
    </button>
  );
}
