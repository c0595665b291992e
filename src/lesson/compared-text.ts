/** What was compared, in words. */
import type { Compared } from './compare.ts';

const NAMES: Readonly<Record<keyof Compared, readonly [one: string, many: string]>> = {
  world: ['world matrix', 'world matrices'],
  local: ['local matrix', 'local matrices'],
  positions: ['joint position', 'joint positions'],
  vertices: ['vertex', 'vertices'],
  normals: ['normal', 'normals'],
  channels: ['channel', 'channels'],
};

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
