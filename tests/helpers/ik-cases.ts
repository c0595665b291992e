/** The reference cases of inverse kinematics, with their skeletons. */
import type { IkPin } from '../../src/evaluate/ik/pins.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { conformance, sharedBytes } from './shared.ts';

export interface IkCases {
  readonly tolerance: number;
  readonly skeletons: Readonly<Record<string, { readonly file: string; readonly reach: number }>>;
  /** Joint, x, y, z. */
  readonly single: Readonly<Record<string, readonly Target[]>>;
  readonly multi: Readonly<Record<string, readonly (readonly Target[])[]>>;
  /** Joint, x, y, z, and the smallest possible distance. */
  readonly unreachable: Readonly<Record<string, readonly (readonly [number, number, number, number, number])[]>>;
  readonly drags: readonly IkDrag[];
}

export type Target = readonly [number, number, number, number];

export interface IkDrag {
  readonly skeleton: string;
  readonly kind: 'free' | 'pinned' | 'out' | 'straight';
  readonly joint: number;
  readonly pinned: readonly Target[];
  /** x y z per step. */
  readonly path: readonly number[];
  /** The smallest possible distance at each step, if the target gets out of reach. */
  readonly optimum?: readonly number[];
  /** Degrees. */
  readonly start?: readonly number[];
}

export const ikCases = () => conformance<IkCases>('ik-cases.json');

/** One of the cases' files. */
export function caseSkeleton({ skeletons }: IkCases, name: string): Skeleton {
  const { file } = skeletons[name];
  const [skeleton] = readSkel(sharedBytes(`data/axis-skel/${file}`), file).value ?? [];
  if (!skeleton) throw new Error(`${file} could not be read`);
  return skeleton;
}

/** A pin of a bone's tip. */
export function tipPin({ joints }: Skeleton, [joint, x, y, z]: readonly number[], holds = false): IkPin {
  return { joint, point: [0, joints[joint].length ?? 0, 0], target: [x, y, z], holds };
}
