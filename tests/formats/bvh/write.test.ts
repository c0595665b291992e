import { describe, expect, it } from 'vitest';
import { fitOneBvh, writeBvh as writeBvhPieces } from '../../../src/formats/bvh/write.ts';
import type { Joint, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { restChannel } from '../../../src/model/takes/take.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { writeBvh } from '../../helpers/bvh-text.ts';

const DANCER: Skeleton = {
  name: 'dancer',
  joints: [
    bvhJoint(-1, ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], { name: 'Hips' }),
    bvhJoint(0, [], { name: 'mixamorig:Spine.001 (upper) #2' }),
    bvhJoint(1, ['rx'], { name: 'Head', endSites: [[0, 4.5, -0]] }),
    bvhJoint(0, ['ry', 'tz'], { name: 'Tail', offset: [0, 0, -5e-7] }),
  ],
};
const ROW = [1.5, 90, 0.1, -0, 1e-7, 359.99999999999994, 45, 12.25, -5];

describe('writing .bvh', () => {
  it('writes joints, channels, End Sites and rows as the format has them', () => {
    expect(writeBvh([captureOf(DANCER, [ROW])])).toEqual({
      text: `HIERARCHY
ROOT Hips
{
	OFFSET 0 1 0
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT mixamorig:Spine.001 (upper) #2
	{
		OFFSET 0 1 0
		CHANNELS 0
		JOINT Head
		{
			OFFSET 0 1 0
			CHANNELS 1 Xrotation
			End Site
			{
				OFFSET 0 4.5 -0
			}
		}
	}
	JOINT Tail
	{
		OFFSET 0 0 -5e-7
		CHANNELS 2 Yrotation Zposition
	}
}
MOTION
Frames: 1
Frame Time: 0.04
1.5 90 0.1 -0 1e-7 359.99999999999994 45 12.25 -5
`,
      diagnostics: [],
    });
  });

  it('writes a character without a take as one without frames', () => {
    expect(writeBvh([{ skeleton: DANCER }]).text).toContain('\nFrames: 0\n');
  });

  it('writes several characters as several roots, rows side by side', () => {
    const one = (name: string): Skeleton => ({ name, joints: [bvhJoint(-1, ['rx'], { name })] });
    const { text } = writeBvh([captureOf(one('A'), [[1], [2]]), captureOf(one('B'), [[3], [4]])]);
    expect(text.match(/^ROOT .*/gm)).toEqual(['ROOT A', 'ROOT B']);
    expect(text.split('\n').slice(-3)).toEqual(['1 3', '2 4', '']);
  });

  it('refuses characters that do not move in the same frames', () => {
    const captures = [captureOf(DANCER, [ROW]), captureOf(DANCER, [ROW, ROW])];
    expect(fitOneBvh(captures)).toBe(false);
    expect(fitOneBvh([captureOf(DANCER, [ROW], 0.04), captureOf(DANCER, [ROW], 0.05)])).toBe(false);
    expect(() => writeBvh(captures)).toThrow('same frames');
  });

  it('changes names that a line can not hold, and says so', () => {
    const joints: Joint[] = ['two\nlines', ' in blanks\t', 'a {brace}', ''].map((name, j) =>
      bvhJoint(j - 1, ['rx'], { name }),
    );
    const { text, diagnostics } = writeBvh([captureOf({ name: 'x', joints }, [[0, 0, 0, 0]])], 'x.bvh');
    expect(text.match(/^\t*(ROOT|JOINT).*/gm)?.map((line) => line.trim())).toEqual([
      'ROOT two_lines',
      'JOINT _in blanks_',
      'JOINT a _brace_',
      'JOINT',
    ]);
    expect(diagnostics.map(({ severity, code, file }) => ({ severity, code, file }))).toEqual(
      Array(3).fill({ severity: 'info', code: 'name-changed', file: 'x.bvh' }),
    );
  });

  it('writes a constant channel in every frame, in degrees', () => {
    const { skeleton, take } = captureOf(DANCER, [ROW, ROW]);
    if (!take) throw new Error('There is a take.');
    const { samples: _, ...still } = take;
    const channels = still.channels.map((_, c) => restChannel(c === 6 ? Math.PI : 0));
    expect(writeBvh([{ skeleton, take: { ...still, channels } }]).text).toMatch(/\n0 0 0 0 0 0 180 0 0\n$/);
  });

  it('adds the offset to positions that are added to it, for in the file they replace it', () => {
    const motion = { kind: 'bvh', channels: ['ty', 'rx'], positions: 'add' } as const;
    const skeleton = { name: 'x', joints: [bvhJoint(-1, ['ty', 'rx'], { motion, offset: [0, 10, 0] })] };
    expect(writeBvh([captureOf(skeleton, [[1, 2]])]).text).toMatch(/\n11 2\n$/);
  });

  it('writing .bvh refuses what is no number, and says in which frame and column', () => {
    const capture = captureOf(DANCER, [ROW, ROW.with(2, Number.NaN)]);
    expect(() => writeBvh([capture])).toThrow('found NaN in frame 2, column 3.');
  });

  it('writing .bvh comes in pieces, none of them long, of any number of frames', () => {
    const rows = Array.from({ length: 20000 }, (_, f) => ROW.map((v) => v + f / 7));
    const capture = captureOf(DANCER, rows);
    const pieces = [...writeBvhPieces([capture]).pieces];
    expect(pieces.length).toBeGreaterThan(10);
    expect(Math.max(...pieces.map((p) => p.length))).toBeLessThan(1 << 17);
    expect(new TextDecoder().decode(Buffer.concat(pieces))).toBe(writeBvh([capture]).text);
  });
});
