/** Motion capture on the built page: dropped, displayed, played, compared with the reference, saved. */
import { readdirSync } from 'node:fs';
import { expect, it } from 'vitest';
import { testAll } from '../helpers/check.ts';
import { expectClose } from '../helpers/close.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { conformance, describeShared, sharedBytes, sharedPath } from '../helpers/shared.ts';
import { CAPTURE, TAKE } from './checks/capture.ts';

interface Reference {
  readonly frame_time: number;
  /** Name, parent, channels; null for an End Site. */
  readonly nodes: readonly (readonly [string, number, string | null])[];
  readonly positions: Readonly<Record<string, readonly (readonly number[])[]>>;
  /** Where the file's writer meant OFFSET + channel, which is recognised. */
  readonly positions_add?: Readonly<Record<string, readonly (readonly number[])[]>>;
  readonly tolerance: number;
}

/** A character as it is drawn: joints, then End Sites, in the order of the file. */
interface Shown {
  readonly joints: readonly { readonly name: string; readonly position: readonly number[] }[];
  readonly endSites: readonly (readonly number[])[];
}

/** The frames of all files by their time, so that the page draws each time once. */
function framesByTime(files: Readonly<Record<string, Reference>>): Map<number, { file: string; frame: string }[]> {
  const found = new Map<number, { file: string; frame: string }[]>();
  for (const [file, { frame_time, positions }] of Object.entries(files)) {
    for (const frame of Object.keys(positions)) {
      const seconds = Number(frame) * frame_time;
      const others = found.get(seconds);
      if (others) others.push({ file, frame });
      else found.set(seconds, [{ file, frame }]);
    }
  }
  return found;
}

function expectAtFrame(figures: readonly Shown[], reference: Reference, frame: string, what: string): void {
  const { nodes, positions, positions_add, tolerance } = reference;
  const isJoint = ([, , channels]: Reference['nodes'][number]) => channels !== null;
  const joints = figures.flatMap((figure) => figure.joints);
  expect(joints.map(({ name }) => name)).toEqual(nodes.filter(isJoint).map(([name]) => name));
  const size = Math.max(1, tolerance / 1e-5);
  const expected = (positions_add ?? positions)[frame];
  const expectNear = (got: readonly (readonly number[])[], wanted: readonly (readonly number[])[]) =>
    expectClose(
      got.flat().map((v) => v / size),
      wanted.flat().map((v) => v / size),
      1e-5,
      what,
    );
  expectNear(
    joints.map(({ position }) => position),
    expected.filter((_, i) => isJoint(nodes[i])),
  );
  expectNear(
    figures.flatMap(({ endSites }) => endSites),
    expected.filter((_, i) => !isJoint(nodes[i])),
  );
}

const inPage = inOnePage();

describeShared('all takes of the field at once', () => {
  const files = () => readdirSync(sharedPath('data/bvh')).filter((name) => name.endsWith('.bvh'));

  inPage(
    'stand where the reference says, joint for joint and End Site for End Site, at every frame it has',
    async ({ page }) => {
      await startOver(page);
      const reference = conformance<{ files: Record<string, Reference> }>('bvh-positions.json').files;
      const names = files();
      await dropFiles(
        page,
        names.map((name) => ({ name, bytes: sharedBytes(`data/bvh/${name}`) })),
      );
      await page.waitForFunction((count) => window.marrow.characters().length >= count, names.length);
      const times = [...framesByTime(reference)];
      // Values are right at once, and drawing follows: once, behind the last time.
      const text = await page.evaluate(
        (asked) =>
          JSON.stringify(
            asked.map(([seconds, stems]) => {
              window.marrow.seek(seconds);
              const all = window.marrow.characters();
              // Several roots are several characters, named after the file and their root.
              return stems.map((stem) =>
                all
                  .filter(({ name }) => name === stem || name.startsWith(`${stem} `))
                  .map(({ id, joints }) => {
                    const world = window.marrow.worldMatrices({ id });
                    return {
                      joints: joints.map((joint, j) => ({ name: joint.name, position: world[j].slice(12, 15) })),
                      endSites: window.marrow.endSites({ id }).map(({ position }) => position),
                    };
                  }),
              );
            }),
          ),
        times.map(([seconds, wanted]) => [seconds, wanted.map(({ file }) => file.replace(/\.bvh$/, ''))] as const),
      );
      // As text: so many numbers one by one take as long as all that is done to them.
      const shown: readonly (readonly (readonly Shown[])[])[] = JSON.parse(text);
      for (const [t, [, wanted]] of times.entries()) {
        for (const [i, { file, frame }] of wanted.entries()) {
          expectAtFrame(shown[t][i], reference[file], frame, `${file}, frame ${frame}`);
        }
      }
      // Any number of them costs the same few draw calls: joints, bones, ground, axes and the selection.
      await expect.poll(async () => (await page.evaluate(() => window.marrow.stats())).drawCalls).toBeLessThan(16);
    },
  );
});

testAll(CAPTURE, inPage);

it('plays one take after the other by key, and compares two by the distance of their joints', () =>
  withPage(async ({ page }) => {
    // Another step: its start is rotated about the hips, which stay in place.
    const turned = TAKE.replace('0 90 0 0 0 0 0 0 0', '0 90 0 90 0 0 0 0 0');
    await dropFiles(page, [
      { name: 'step.bvh', bytes: TAKE },
      { name: 'turned.bvh', bytes: turned },
    ]);
    await page.waitForFunction(() => window.marrow.characters().length >= 2);
    await page.getByRole('tab', { name: 'Takes' }).click();
    const rows = page.getByRole('grid').getByRole('row');
    // The header is a row too.
    await expect.poll(() => rows.count()).toBe(3);

    await page.evaluate(() => window.marrow.run('take.next'));
    await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toContain('turned');

    await rows.filter({ hasText: 'step' }).first().click();
    const compare = page.getByRole('button', { name: 'Compare' });
    const before = await compare.boundingBox();
    await rows
      .filter({ hasText: 'turned' })
      .first()
      .click({ modifiers: ['ControlOrMeta'] });
    await page.locator('.take-count').filter({ hasText: '2 selected' }).waitFor();
    await expect.poll(async () => (await compare.boundingBox())?.x).toBe(before?.x);
    await compare.click();
    const joints = page.getByRole('listbox', { name: 'Joints by distance' }).getByRole('option');
    await expect.poll(() => joints.count()).toBe(2);
    // The legs differ, the hips don't: the list starts with the largest difference.
    await expect.poll(() => joints.first().textContent()).toContain('Leg');
    await expect.poll(() => joints.last().textContent()).toBe('Hips00');

    // The largest distance is a click away, by the summary, by a double click, and by Enter.
    const time = page.getByRole('textbox', { name: 'Time in seconds', exact: true });
    const most = page.getByRole('button', { name: /^max / });
    const at = /at ([\d.]+) s/.exec((await most.textContent()) ?? '')?.[1] ?? '';
    await page.evaluate(() => window.marrow.seek(0.1));
    await most.click();
    await expect.poll(() => time.inputValue()).toBe(at);
    await expect.poll(() => joints.first().getAttribute('aria-selected')).toBe('true');
    await page.evaluate(() => window.marrow.seek(0.1));
    await joints.first().dblclick();
    await expect.poll(() => time.inputValue()).toBe(at);
    await page.evaluate(() => window.marrow.seek(0.1));
    await page.getByRole('listbox', { name: 'Joints by distance' }).press('Enter');
    await expect.poll(() => time.inputValue()).toBe(at);
    // Deselected, it isn't drawn on its own any more.
    await page.keyboard.press('Escape');
    await expect.poll(() => joints.first().getAttribute('aria-selected')).toBe('false');
    // A drag past the edge of the chart stops at the first frame.
    const chart = await page.locator('.distance .time-chart').boundingBox();
    if (!chart) throw new Error('the chart is not shown');
    await page.mouse.move(chart.x + 60, chart.y + 60);
    await page.mouse.down();
    await page.mouse.move(chart.x - 300, chart.y + 60, { steps: 5 });
    await page.mouse.up();
    await expect.poll(() => time.inputValue()).toBe('0');

    // With a third take one is selected, and the other chosen in a menu: no key is needed.
    await page.getByRole('button', { name: 'Stop comparing' }).first().click();
    await dropFiles(page, [{ name: 'third.bvh', bytes: TAKE }]);
    await expect.poll(() => rows.count()).toBe(4);
    await rows.filter({ hasText: 'step' }).first().click();
    await page.getByRole('button', { name: 'Compare with' }).click();
    await page.getByRole('menuitem', { name: 'third' }).click();
    await page.getByRole('button', { name: 'Stop comparing' }).first().waitFor();
    // They are the same.
    await expect.poll(() => joints.first().textContent()).toMatch(/00$/);

    // Names of a series begin alike: where one doesn't fit, its end is shown.
    await dropFiles(page, [{ name: 'a-long-series-of-captures-in-a-studio-take-0017.bvh', bytes: TAKE }]);
    const cut = page.locator('.file-row .middle-cut[role="img"]').first();
    await expect
      .poll(() =>
        cut.evaluate((name) => {
          const [head, tail] = [...name.children];
          const isWhole = tail.getBoundingClientRect().right <= name.getBoundingClientRect().right;
          return { tail: tail.textContent, isWhole, isCut: head.scrollWidth > head.clientWidth };
        }),
      )
      .toEqual({ tail: '17.bvh', isWhole: true, isCut: true });
  }));
