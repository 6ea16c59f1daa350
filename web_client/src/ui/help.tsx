import type { Signal } from "@preact/signals";
import { Dialog } from "./dialog";

const kRows: readonly (readonly [keys: string, what: string])[] = [
  ["Drag, arrows", "Turn"],
  ["Right or Shift drag, Shift arrows", "Move"],
  ["Wheel, + and −", "Closer and farther"],
  ["One finger, two fingers", "Turn; move and pinch"],
  ["Double click, R or 0", "Show everything"],
  ["1 2 3 or X Y Z", "Look along an axis; with Shift from behind"],
  ["P", "Perspective or orthographic"],
  ["W A S D, Q and E", "Fly; with Shift fast. A drag meanwhile looks around"],
  ["Alt drag", "Look around from where one is"],
  ["T", "Turn as a turntable or as a trackball"],
  ["B, L, H", "Bounding box, legend, performance"],
  ["C", "Save the picture, lossless"],
  ["F", "Full screen"],
  ["Ctrl Z, Ctrl Shift Z", "Undo and redo any setting"],
  ["I, or a tap", "Keep the values under the pointer (or in the middle), to copy them"],
  ["?", "This help"],
];

const kClipRows: readonly (readonly [keys: string, what: string])[] = [
  ["Drag, arrows", "Move a plane; with Shift in small steps"],
  ["Page Up and Down, Home, End", "Far; to the ends of the data"],
  ["Delete", "Remove the plane"],
  ["Square, arrows, Page Up and Down", "Move the whole box"],
];

const kMapRows: readonly (readonly [keys: string, what: string])[] = [
  [
    "Click, tap",
    "Add a point that changes nothing yet; with Shift, Ctrl or Alt in the selected colour",
  ],
  ["Drag, arrows", "Move a point; with Shift in small steps"],
  ["Double click, Delete, middle click", "Delete the point"],
  ["Right click, long press", "Another colour for the point"],
  ["Shift, Ctrl or Alt click on a point", "Give it the selected colour"],
  ["Ctrl wheel, pinch", "Closer; Shift wheel or a drag of the ground moves"],
];

function Keys({ rows }: { readonly rows: typeof kRows }) {
  return (
    <dl class="keys">
      {rows.map(([keys, what]) => (
        <div key={keys}>
          <dt>{keys}</dt>
          <dd>{what}</dd>
        </div>
      ))}
    </dl>
  );
}

/** Everything that hands can do here. */
export function Help({ open }: { readonly open: Signal<boolean> }) {
  if (!open.value) return null;
  const close = (): void => {
    open.value = false;
  };
  return (
    <Dialog id="help-heading" heading="Controls" close={close}>
      <h3>Picture</h3>
      <Keys rows={kRows} />
      <h3>Handles of clip planes</h3>
      <Keys rows={kClipRows} />
      <h3>Colours and opacity</h3>
      <Keys rows={kMapRows} />
    </Dialog>
  );
}
