import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { IconButton } from "./icons";

interface Props {
  /** Of its heading, unique on the page. */
  readonly id: string;
  readonly heading: string;
  readonly look?: string | undefined;
  readonly close: () => void;
  readonly children: ComponentChildren;
}

/**
 * A modal dialog, open as long as it is on the page: the browser keeps the focus in it, gives it
 * back to where it was, and closes it by Escape.
 */
export function Dialog({ id, heading, look = "", close, children }: Props) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const shown = dialog.current;
    shown?.showModal();
    return () => shown?.close();
  }, []);
  return (
    <dialog ref={dialog} class={`dialog ${look}`} aria-labelledby={id} onClose={close}>
      <header>
        <h2 id={id}>{heading}</h2>
        <IconButton icon="close" label="Close" onClick={() => dialog.current?.close()} />
      </header>
      {children}
    </dialog>
  );
}
