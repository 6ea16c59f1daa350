import { writeFileSync } from "node:fs";
import { join } from "node:path";

interface Grid {
  readonly size: readonly [number, number, number];
  readonly spacing?: readonly [number, number, number];
  /** The value of a grid point; bytes. */
  readonly value: (x: number, y: number, z: number) => number;
}

/** Writes voxels of bytes as NAME.mhd and NAME.raw. */
export function writeVoxels(folder: string, name: string, { size, spacing, value }: Grid): void {
  const header = [
    "ObjectType = Image",
    "NDims = 3",
    `DimSize = ${size.join(" ")}`,
    ...(spacing ? [`ElementSpacing = ${spacing.join(" ")}`] : []),
    "ElementType = MET_UCHAR",
    `ElementDataFile = ${name}.raw`,
  ];
  writeFileSync(join(folder, `${name}.mhd`), `${header.join("\n")}\n`);
  const [nx, ny, nz] = size;
  const voxels = new Uint8Array(nx * ny * nz);
  for (let i = 0; i < voxels.length; i += 1) {
    voxels[i] = value(i % nx, Math.floor(i / nx) % ny, Math.floor(i / (nx * ny)));
  }
  writeFileSync(join(folder, `${name}.raw`), voxels);
}

/** A ball of values that fall from its middle. */
export function writeBall(folder: string, name: string, side: number): void {
  const middle = (side - 1) / 2;
  const value = (x: number, y: number, z: number): number =>
    Math.max(0, 255 - (504 / side) * Math.hypot(x - middle, y - middle, z - middle));
  writeVoxels(folder, name, { size: [side, side, side], value });
}
