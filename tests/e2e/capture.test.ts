/** Motion capture on the built page: dropped, looked at, played, compared with the reference, saved. */
import { readdirSync } from 'node:fs';
import { expect, it } from 'vitest';
import { expectClose } from '../helpers/close.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { conformance, describeShared, sharedBytes, sharedPath } from '../helpers/shared.ts';

interface Reference {
  readonly frame_time: number;
  /** Name, parent, channels; null for an End Site. */
  readonly nodes: readonly (readonly [string, number, string | null])[];
  readonly positions: Readonly<Record<string, readonly (readonly number[])[]>>;
  readonly tolerance: number;
}

/** Joints by name, parent and positions, then End Sites, as the reference lists them: in the order of the file. */
interface Shown {
  readonly joints: readonly { readonly name: string; readonly position: readonly number[] }[];
  readonly endSites: readonly (readonly number[])[];
}

describeShared('all takes of the field at once', () => {
  const files = () => readdirSync(sharedPath('data/bvh')).filter((name) => name.endsWith('.bvh'));

  it('stand where the reference says, joint for joint and End Site for End Site, at every frame it has', () =>
    withPage(async ({ page }) => {
      const reference = conformance<{ files: Record<string, Reference> }>('bvh-positions.json').files;
      const names = files();
      await dropFiles(
        page,
        names.map((name) => ({ name, bytes: sharedBytes(`data/bvh/${name}`) })),
      );
      await page.waitForFunction((count) => window.marrow.characters().length >= count, names.length);
      for (const name of names) {
        const { frame_time, nodes, positions, tolerance } = reference[name];
        for (const [frame, expected] of Object.entries(positions)) {
          const seconds = Number(frame) * frame_time;
          const shown = await page.evaluate(
            async ([stem, time]) => {
              window.marrow.seek(time);
              await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
              // Several roots are several characters, called after the file and their root.
              const figures = window.marrow
                .characters()
                .filter(({ name }) => name === stem || name.startsWith(`${stem} `));
              return figures.map(({ id, joints }): Shown => {
                const world = window.marrow.worldMatrices({ id });
                return {
                  joints: joints.map(({ name }, j) => ({ name, position: world[j].slice(12, 15) })),
                  endSites: window.marrow.endSites({ id }).map(({ position }) => position),
                };
              });
            },
            [name.replace(/\.bvh$/, ''), seconds] as const,
          );
          const isJoint = (node: Reference['nodes'][number]) => node[2] !== null;
          const joints = shown.flatMap((figure) => figure.joints);
          expect(joints.map((joint) => joint.name)).toEqual(nodes.filter(isJoint).map(([joint]) => joint));
          const size = Math.max(1, tolerance / 1e-5);
          const compare = (got: readonly (readonly number[])[], of: (node: Reference['nodes'][number]) => boolean) =>
            expectClose(
              got.flat().map((v) => v / size),
              expected.filter((_, i) => of(nodes[i])).flatMap((p) => p.map((v) => v / size)),
              1e-5,
              `${name}, frame ${frame}`,
            );
          compare(
            joints.map((joint) => joint.position),
            isJoint,
          );
          compare(
            shown.flatMap((figure) => figure.endSites),
            (node) => !isJoint(node),
          );
        }
      }
      // However many they are, they cost the same few draw calls: joints, bones, ground, axes and what is selected.
      expect((await page.evaluate(() => window.marrow.stats())).drawCalls).toBeLessThan(16);
    }));
});

const TAKE = `HIERARCHY
ROOT Hips
{
\tOFFSET 0 90 0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Leg
\t{
\t\tOFFSET 0 -45 0
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0 -45 0
\t\t}
\t}
}
MOTION
Frames: 3
Frame Time: 0.1
0 90 0 0 0 0 0 0 0
5 90 0 10 20 30 0 15 0
10 90 0 0 0 0 90 0 0
`;

it('opens a take, plays it between its frames, and writes the bytes that it read', () =>
  withPage(async ({ page }) => {
    await dropFiles(page, [{ name: 'step.bvh', bytes: TAKE }]);
    await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'step'));
    const ends = () =>
      page.evaluate(async () => {
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
        return window.marrow.endSites('step').map(({ position }) => position);
      });
    await page.evaluate(() => window.marrow.seek(0));
    expectClose((await ends()).flat(), [0, 0, 0], 1e-9);
    await page.evaluate(() => window.marrow.seek(0.2));
    expectClose((await ends()).flat(), [55, 45, 0], 1e-9);
    expect(await page.evaluate(() => window.marrow.save('step.bvh'))).toBe(TAKE);
  }));

it('plays one take after the other by key, and compares two by the distance of their joints', () =>
  withPage(async ({ page }) => {
    // Another step: it begins turned about the hips, which stay where they are.
    const turned = TAKE.replace('0 90 0 0 0 0 0 0 0', '0 90 0 90 0 0 0 0 0');
    await dropFiles(page, [
      { name: 'step.bvh', bytes: TAKE },
      { name: 'turned.bvh', bytes: turned },
    ]);
    await page.waitForFunction(() => window.marrow.characters().length >= 2);
    await page.getByRole('tab', { name: 'Takes' }).click();
    const rows = page.getByRole('grid').getByRole('row');
    // The heading is a row too.
    await expect.poll(() => rows.count()).toBe(3);

    await page.evaluate(() => window.marrow.run('take.next'));
    expect(await page.evaluate(() => window.marrow.steps().undo)).toContain('turned');

    await rows.filter({ hasText: 'step' }).first().click();
    await rows
      .filter({ hasText: 'turned' })
      .first()
      .click({ modifiers: ['ControlOrMeta'] });
    await page.getByRole('button', { name: 'Compare' }).click();
    const joints = page.getByRole('listbox', { name: 'Joints by distance' }).getByRole('option');
    await expect.poll(() => joints.count()).toBe(2);
    // The legs differ, the hips never do: the list begins with what differs most.
    expect(await joints.first().textContent()).toContain('Leg');
    expect(await joints.last().textContent()).toBe('Hips00');
  }));
