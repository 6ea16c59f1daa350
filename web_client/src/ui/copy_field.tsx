import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";

interface Props {
  readonly label: string;
  readonly text: string;
}

/** Copies by the clipboard, where the page may use it; plain http has only the older way. */
async function copy(field: HTMLInputElement): Promise<boolean> {
  field.select();
  try {
    await navigator.clipboard.writeText(field.value);
    return true;
  } catch {
    return document.execCommand("copy");
  }
}

/** A text to pass on, with a button that copies it. */
export function CopyField({ label, text }: Props) {
  const field = useRef<HTMLInputElement>(null);
  const said = useSignal("");
  return (
    <div class="copy-field">
      <input ref={field} type="text" readOnly value={text} aria-label={label} />
      <button
        type="button"
        class="text-button"
        aria-label={`Copy: ${label}`}
        onClick={async () => {
          const copied = field.current !== null && (await copy(field.current));
          said.value = copied ? "Copied" : "Press Ctrl C";
        }}
      >
        Copy
      </button>
      <span class="hint" role="status">
        {said.value}
      </span>
    </div>
  );
}
