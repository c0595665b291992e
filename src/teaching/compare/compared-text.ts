/** Words for what was compared, and for what a cause is about. */

import type { Cause, CauseSubject } from '../search/found-causes.ts';
import type { Compared, Comparison } from './compare.ts';

const NAMES: Readonly<Record<keyof Compared, readonly [one: string, many: string]>> = {
  world: ['world matrix', 'world matrices'],
  local: ['local matrix', 'local matrices'],
  positions: ['joint position', 'joint positions'],
  vertices: ['vertex', 'vertices'],
  normals: ['normal', 'normals'],
  channels: ['channel', 'channels'],
};

/** `world matrices of anna.txt`: what a cause of a part is about. @param hasSeveral dumps, so that they are named */
export function subjectText({ kinds, files }: CauseSubject, hasSeveral: boolean): string {
  const named = kinds.map((kind) => NAMES[kind][1]).join(', ');
  return hasSeveral ? `${named} of ${files.join(', ')}` : named;
}

/** Noun for an explained item: a joint, a vertex or a channel. */
export function explainedNoun({ about }: Cause, compared: Compared): 'joint' | 'vertex' | 'channel' {
  const has = (kind: keyof Compared) => (about ? about.kinds.includes(kind) : compared[kind] > 0);
  if (has('world') || has('local') || has('positions')) return 'joint';
  return has('vertices') || has('normals') ? 'vertex' : 'channel';
}

/**
 * Where points of a solver are, what no mistake explains, and how the numbers differ, in sentences of which each may be
 * a line; of numbers of a character none where all agrees or is explained.
 */
export function unexplainedSentences(
  {
    agrees,
    causes,
    unexplained,
    pattern,
    reached = [],
  }: Pick<Comparison, 'agrees' | 'causes' | 'unexplained' | 'pattern' | 'reached'>,
  hasSeveral: boolean,
): readonly string[] {
  // Of a solver alone its sentences say it.
  const isOfNone = causes.length === 0 && !agrees && (reached.length === 0 || pattern !== undefined);
  const what = unexplained ? `all of the ${subjectText(unexplained, hasSeveral)}` : 'these numbers';
  return [
    ...reached,
    ...(unexplained || isOfNone ? [`No known mistake, alone or with another, explains ${what}.`] : []),
    ...(pattern ? [`What differs: ${pattern}`] : []),
  ];
}

/** Whether causes explain the same numbers, all of them: these can't tell them apart. */
export function areEqual(causes: readonly Cause[]): boolean {
  const subjects = causes.map(({ about }) => JSON.stringify(about ?? null));
  return causes.length > 1 && new Set(subjects).size === 1 && causes.every(({ explains, of }) => explains === of);
}

/** `23 world matrices at 11 times; 72 channels`. @param times of the frames; the counts are of all of them */
export function comparedText({ channels, ...ofFrames }: Compared, times: number): string {
  const all = Object.entries(ofFrames);
  const isEven = times > 1 && all.every(([, count]) => count % times === 0);
  const counted = (kind: keyof Compared, count: number) => `${count} ${NAMES[kind][count === 1 ? 0 : 1]}`;
  const named = all
    .filter(([, count]) => count > 0)
    // Its keys are those of `Compared`, which TypeScript types as strings.
    .map(([kind, count]) => counted(kind as keyof Compared, isEven ? count / times : count))
    .join(', ');
  const frames = named && times > 1 ? `${named} at ${times} times` : named;
  return (
    [frames, channels > 0 ? counted('channels', channels) : ''].filter((text) => text !== '').join('; ') || 'nothing'
  );
}

/** Text on where to begin with what no mistake explains. Only of joints it is known which are wrong by themselves. */
export function beginText({ own }: Pick<Comparison, 'own'>): string {
  return `Start with ${own.length > 0 ? 'the first joint with an error of its own' : 'the first one that differs'}.`;
}
