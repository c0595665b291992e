/** What ufbx says of the public FBX files. */
import { conformance } from '../../helpers/shared.ts';

export interface Expected {
  readonly nodes: readonly (readonly [string, number])[];
  readonly takes: readonly {
    readonly name: string;
    readonly at: readonly {
      readonly t: number;
      readonly nodes: readonly number[];
      readonly vertices?: readonly number[];
    }[];
  }[];
}

export const FBX_FILES = [
  'maya_game_sausage_7500_binary_combined',
  'maya_pivot_offset_7700_ascii',
  'maya_anim_layers_7500_ascii',
  'blender_279_sausage_7400_binary',
  'maya_blend_shape_cube_7700_binary',
  'blender440_shape_weight_anim_7400_binary',
  '91_48',
];

export function expectedOf(name: string): Expected {
  return conformance<Expected>(`fbx/${name}.json`);
}

function sizeOf(numbers: readonly number[]): number {
  const spans = [0, 1, 2].map((k) => {
    const own = numbers.filter((_, i) => i % 3 === k);
    return own.reduce((a, b) => Math.max(a, b)) - own.reduce((a, b) => Math.min(a, b));
  });
  return Math.hypot(...spans);
}

/** Of all that the file says about a take. */
export function takeSize({ at }: Expected['takes'][number]): number {
  return Math.max(...at.map(({ nodes, vertices = [] }) => sizeOf([...nodes, ...vertices])));
}

export function distance(a: ArrayLike<number>, i: number, b: ArrayLike<number>, j: number): number {
  return Math.hypot(a[3 * i] - b[3 * j], a[3 * i + 1] - b[3 * j + 1], a[3 * i + 2] - b[3 * j + 2]);
}
