/** What the list of takes shows of one, made where its file is read: the file's numbers are not kept. */

import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';
import type { TakeFacts } from './list.ts';
import { type StickFigure, stickFigure } from './stick-figure.ts';
import { takeFacts } from './take-facts.ts';

export interface TakeDigest {
  readonly path: string;
  /** Absent if the file could not be read, or has no frames. */
  readonly found?: { readonly facts: TakeFacts; readonly figure: StickFigure };
  /** Why not, in a sentence. */
  readonly problem?: string;
}

/** A take in a file; a file of several figures has several. */
export interface TakeRead {
  readonly skeleton: Skeleton;
  readonly take: Take;
  readonly space: Space | undefined;
}

/** The first one is counted and drawn; flags are those of all. */
export function digestOf(path: string, takes: readonly TakeRead[]): TakeDigest {
  const [first] = takes;
  if (!first) return { path, problem: 'The file has no frames.' };
  const [facts, ...others] = takes.map(({ skeleton, take, space }) => takeFacts(skeleton, take, space));
  const flags = [...facts.flags, ...others.flatMap((other) => other.flags)];
  return {
    path,
    found: { facts: { ...facts, flags }, figure: stickFigure(first.skeleton, first.take, first.space) },
  };
}
