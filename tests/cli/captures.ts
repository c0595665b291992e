/** Small captures for tests of the command. */
import { mkdirSync, mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** Motion capture of a root with a joint. @param more roots */
export const bvh = (name: string, rows: readonly string[], more = '') => `HIERARCHY
ROOT ${name} {
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm { OFFSET 0 10 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 5 0 } }
}
${more}MOTION
Frames: ${rows.length}
Frame Time: 0.1
${rows.join('\n')}
`;
/** One metre in eleven frames. */
export const WALK = bvh(
  'Hips',
  Array.from({ length: 11 }, (_, f) => `${10 * f} 90 0 0 0 0 0 ${6 * f} 0`),
);
/** Of two characters. */
export const TWO = bvh(
  'Left',
  ['0 90 0 0 0 0 0 0 0 9 90 0 0 0 0', '0 90 0 0 0 0 0 0 0 9 91 0 0 0 0'],
  'ROOT Right { OFFSET 0 0 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation }\n',
);

/** A new folder with `takes/walk.bvh`, `takes/b/walk.bvh` and `takes/two.bvh`. */
export function makeTakes(): string {
  const folder = mkdtempSync(join(tmpdir(), 'marrow-takes-'));
  mkdirSync(join(folder, 'takes', 'b'), { recursive: true });
  writeFileSync(join(folder, 'takes', 'walk.bvh'), WALK);
  writeFileSync(join(folder, 'takes', 'b', 'walk.bvh'), WALK);
  writeFileSync(join(folder, 'takes', 'two.bvh'), TWO);
  return folder;
}
