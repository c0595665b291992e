/** Real captures as VRM animations: arms and legs of the T-pose, and what a loader needs. */
import { expect, it } from 'vitest';
import { loadFiles } from '../../../src/cli/load.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { complaintsOf } from '../../helpers/glb.ts';
import { describeShared, sharedPath } from '../../helpers/shared.ts';
import { farthestDistance, slant, vrmaOf } from './vrma-file.ts';

const CAPTURES = [
  'cmu-01_01',
  'mixamo-names',
  'lafan1-dance-10frames',
  'rokoko-dance',
  'bandai-namco-bow-normal',
  'makehuman-tpose-add',
  'xsens-armchair',
];

/** Seconds of a take, which most of them reach: fitting keys to more of it takes longer, and shows nothing else. */
const MAX_SECONDS = 2;

describeShared('real captures as VRM animations', () => {
  it.each(CAPTURES)('%s stands in a T-pose, and keeps its distances', async (name) => {
    const { files } = loadFiles([sharedPath(`data/bvh/${name}.bvh`)], '/');
    const [opened] = openFiles(EMPTY_DOCUMENT, files).document.characters;
    const takes = opened.takes.map(({ range: [start, end], ...take }) => ({
      ...take,
      range: [start, Math.min(end, start + MAX_SECONDS)] as const,
    }));
    const own = { ...opened, takes };
    const made = vrmaOf(own);
    expect(await complaintsOf(made.bytes)).toEqual([]);
    for (const [side, x] of [
      ['left', 1],
      ['right', -1],
    ] as const) {
      expect(slant(made, `${side}UpperArm`, `${side}Hand`, [x, 0, 0])).toBeLessThan(6);
      expect(slant(made, `${side}UpperLeg`, `${side}Foot`, [0, -1, 0])).toBeLessThan(12);
    }
    expect(made.at('hips')[1]).toBeGreaterThan(0.5);
    expect(made.at('hips')[1]).toBeLessThan(1.4);
    expect(await farthestDistance(own, made)).toBeLessThan(made.report.size / 500);
  });
});
