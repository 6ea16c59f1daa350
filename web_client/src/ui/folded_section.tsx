import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

interface Props {
  readonly heading: string;
  readonly open: Signal<boolean>;
  /** Classes beside `explain`. */
  readonly look?: string;
  readonly children: ComponentChildren;
}

/** A section that is its heading alone until it is opened: only then what is in it is there. */
export function FoldedSection({ heading, open, look = "", children }: Props) {
  return (
    <section class="section">
      <details
        class={`explain ${look}`}
        onToggle={(e) => {
          open.value = e.currentTarget.open;
        }}
      >
        <summary>
          <h2>{heading}</h2>
        </summary>
        {open.value && children}
      </details>
    </section>
  );
}
