/** Reads pictures back as they were decoded: RGBA8, rows from the top, alpha not multiplied in. */
export class PixelReader {
  readonly #gl = new OffscreenCanvas(1, 1).getContext("webgl2");
  #canvas: OffscreenCanvas | undefined;

  /** Undefined where this browser gives no way to the unaltered pixels. */
  read(bitmap: ImageBitmap): Uint8Array | undefined {
    return this.#gl && !this.#gl.isContextLost()
      ? readByWebGl(this.#gl, bitmap)
      : this.#readByCanvas(bitmap);
  }

  /** A canvas multiplies alpha in, which only opaque pixels survive. */
  #readByCanvas(bitmap: ImageBitmap): Uint8Array | undefined {
    const { width, height } = bitmap;
    this.#canvas ??= new OffscreenCanvas(width, height);
    this.#canvas.width = width;
    this.#canvas.height = height;
    const context = this.#canvas.getContext("2d", { colorSpace: "srgb", willReadFrequently: true });
    if (!context) return undefined;
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    for (let i = 3; i < data.length; i += 4) {
      if (data[i] !== 255) return undefined;
    }
    return new Uint8Array(data.buffer);
  }
}

function readByWebGl(gl: WebGL2RenderingContext, bitmap: ImageBitmap): Uint8Array | undefined {
  const { width, height } = bitmap;
  const texture = gl.createTexture();
  const target = gl.createFramebuffer();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const complete = gl.checkFramebufferStatus(gl.FRAMEBUFFER) === gl.FRAMEBUFFER_COMPLETE;
  const pixels = new Uint8Array(4 * width * height);
  if (complete) gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  gl.deleteFramebuffer(target);
  gl.deleteTexture(texture);
  return complete && gl.getError() === gl.NO_ERROR ? pixels : undefined;
}
