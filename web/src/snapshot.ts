// The picture as it stands, in other places than its canvas.

// As wide and high as the pictures of the presets.
const [WIDTH, HEIGHT] = [192, 144];

/** A canvas of display codes (RGBA, row 0 at the top). */
export function canvasOf(codes: Uint8Array, size: readonly number[]): OffscreenCanvas {
  const [width, height] = size as [number, number];
  const canvas = new OffscreenCanvas(width, height);
  const image = new ImageData(new Uint8ClampedArray(codes), width, height);
  canvas.getContext("2d")!.putImageData(image, 0, 0);
  return canvas;
}

/** Address of a small picture of the same, cut to its shape. */
export function miniature(codes: Uint8Array, size: readonly number[]): string {
  const whole = canvasOf(codes, size);
  const small = document.createElement("canvas");
  [small.width, small.height] = [WIDTH, HEIGHT];
  const scale = Math.max(WIDTH / whole.width, HEIGHT / whole.height);
  const [across, down] = [WIDTH / scale, HEIGHT / scale];
  const [left, top] = [(whole.width - across) / 2, (whole.height - down) / 2];
  const context = small.getContext("2d")!;
  context.imageSmoothingQuality = "high";
  context.drawImage(whole, left, top, across, down, 0, 0, WIDTH, HEIGHT);
  return small.toDataURL();
}
