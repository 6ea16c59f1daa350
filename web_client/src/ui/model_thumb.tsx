import { useEffect, useRef } from "preact/hooks";
import type { RayModel } from "../net/gen/volcast/v1/scene_pb";
import type { AppState } from "../state/app_state";
import { kThumbnailHeight, kThumbnailWidth } from "../state/model_thumbnails";

interface Props {
  readonly state: AppState;
  readonly model: RayModel;
}

/** What a ray model makes of the data as it is shown; empty until it is there. */
export function ModelThumb({ state, model }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const thumbnail = state.thumbnails.value.get(model);
  const picture = thumbnail?.picture;
  useEffect(() => {
    let ended = false;
    const draw = async (): Promise<void> => {
      if (!picture) return;
      const bitmap = await createImageBitmap(picture);
      const target = canvas.current;
      if (target && !ended) {
        target.width = bitmap.width;
        target.height = bitmap.height;
        target.getContext("2d")?.drawImage(bitmap, 0, 0);
        target.dataset.drawn = String(Number(target.dataset.drawn ?? 0) + 1);
      }
      bitmap.close();
    };
    draw().catch(() => undefined); // The name below says what it is all the same.
    return () => {
      ended = true;
    };
  }, [picture]);
  return (
    <>
      <span class="model-thumb" aria-hidden="true">
        <canvas ref={canvas} width={kThumbnailWidth} height={kThumbnailHeight} data-model={model} />
      </span>
      {thumbnail?.refusal && <span class="spoken">Cannot be drawn: {thumbnail.refusal}</span>}
    </>
  );
}
