/** The element that takes the hands, with the canvas that shows the pictures. */
export interface PictureElement {
  readonly element: HTMLDivElement;
  readonly canvas: HTMLCanvasElement;
}

export function createPictureElement(): PictureElement {
  const element = document.createElement("div");
  element.className = "picture";
  element.tabIndex = 0;
  element.setAttribute("role", "application");
  element.setAttribute("aria-label", "Picture: arrows turn, plus and minus dolly, ? for help");
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-hidden", "true");
  element.append(canvas);
  return { element, canvas };
}

/**
 * While an element has another shape than its picture, the picture keeps its height: the camera's
 * angle is vertical, so what is seen is what will be drawn, cut or with room at its sides.
 */
export function keepHeight({ element, canvas }: PictureElement, pictureAspect: number): void {
  const aspect = element.clientWidth / Math.max(1, element.clientHeight);
  canvas.style.objectFit =
    Math.abs(aspect / pictureAspect - 1) < 0.02
      ? "fill"
      : aspect < pictureAspect
        ? "cover"
        : "contain";
}
