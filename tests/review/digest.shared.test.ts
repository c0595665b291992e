/** What the list of takes shows of files of other programs. */
import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { reviewTakes } from '../../src/worker/review.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

const FILES = ['data/fbx/91_48.fbx', 'data/gltf/Fox.glb'];

describeShared('takes of other programs in review', () => {
  it.each(FILES)('%s is counted, checked and drawn', async (path) => {
    const { takes } = await reviewTakes({ files: [{ path, blob: new Blob([readFileSync(sharedPath(path))]) }] });
    const [{ found, problem }] = takes;
    expect(problem).toBeUndefined();
    expect(found?.facts.frames).toBeGreaterThan(1);
    expect(found?.facts.joints).toBeGreaterThan(1);
    expect(found?.figure.frameCount).toBeGreaterThan(1);
  });
});
