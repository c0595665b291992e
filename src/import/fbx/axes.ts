/** The axes and the unit of an FBX file, as its settings state them. */
import type { Properties } from './document.ts';

/** The axes of a file, and how they are turned to ours. */
export interface FbxAxes {
  /** 16 numbers: from the file's axes to right-handed ones with y up. */
  readonly matrix: Float64Array;
  readonly isIdentity: boolean;
  /** For users: `z`, `-x` … */
  readonly up: string;
  readonly isLeftHanded: boolean;
}

/** Undefined if the settings name an axis twice. */
export function axesOf(settings: Properties): FbxAxes | undefined {
  const axis = (name: string, otherwise: number) => ({
    index: settings.number(`${name}Axis`) ?? otherwise,
    sign: (settings.number(`${name}AxisSign`) ?? 1) < 0 ? -1 : 1,
  });
  // To the right, up, and towards the viewer.
  const rows = [axis('Coord', 0), axis('Up', 1), axis('Front', 2)];
  const matrix = new Float64Array(16);
  matrix[15] = 1;
  for (const [row, { index, sign }] of rows.entries()) {
    if (index !== 0 && index !== 1 && index !== 2) return undefined;
    matrix[4 * index + row] = sign;
  }
  const determinant =
    matrix[0] * (matrix[5] * matrix[10] - matrix[9] * matrix[6]) -
    matrix[4] * (matrix[1] * matrix[10] - matrix[9] * matrix[2]) +
    matrix[8] * (matrix[1] * matrix[6] - matrix[5] * matrix[2]);
  if (determinant === 0) return undefined;
  const up = rows[1];
  return {
    matrix,
    isIdentity: matrix.every((value, i) => value === (i % 5 === 0 ? 1 : 0)),
    up: `${up.sign < 0 ? '-' : ''}${'xyz'[up.index]}`,
    isLeftHanded: determinant < 0,
  };
}

/** Lengths of real units are between an ångström and a light second. */
const UNITS = [1e-10, 3e8] as const;

/** Metres per unit of length: the format's centimetre, unless the settings state another; undefined if that is none. */
export function metresOf(settings: Properties): number | undefined {
  const metres = (settings.number('UnitScaleFactor') ?? 1) / 100;
  return metres >= UNITS[0] && metres <= UNITS[1] ? metres : undefined;
}
