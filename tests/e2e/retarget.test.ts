/** Retargeting to the walker on the built page: by menu and keyboard, played, baked, saved, undone, redone. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { expectClose } from '../helpers/close.ts';
import { commandJson, type PoseJson } from '../helpers/command.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

interface Part {
  readonly name: string;
  readonly offset: readonly [number, number, number];
  readonly parts?: readonly Part[];
}

/** A leg or arm with Mixamo's names: the left one's x is positive for a person facing +z. */
const limb = (side: 'Left' | 'Right'): { readonly leg: Part; readonly arm: Part } => {
  const x = side === 'Left' ? 1 : -1;
  const toe: Part = { name: `${side}ToeBase`, offset: [0, -8, 12] };
  const foot: Part = { name: `${side}Foot`, offset: [0, -42, 0], parts: [toe] };
  const shin: Part = { name: `${side}Leg`, offset: [0, -42, 0], parts: [foot] };
  const hand: Part = { name: `${side}Hand`, offset: [25 * x, 0, 0] };
  const forearm: Part = { name: `${side}ForeArm`, offset: [28 * x, 0, 0], parts: [hand] };
  const upper: Part = { name: `${side}Arm`, offset: [12 * x, 0, 0], parts: [forearm] };
  return {
    leg: { name: `${side}UpLeg`, offset: [10 * x, -4, 0], parts: [shin] },
    arm: { name: `${side}Shoulder`, offset: [5 * x, 18, 0], parts: [upper] },
  };
};
const [LEFT, RIGHT] = [limb('Left'), limb('Right')];
const HEAD: Part = { name: 'Head', offset: [0, 10, 0] };
const NECK: Part = { name: 'Neck', offset: [0, 22, 0], parts: [HEAD] };
const CHEST: Part = { name: 'Spine1', offset: [0, 14, 0], parts: [LEFT.arm, NECK, RIGHT.arm] };
/** Twenty joints, 1.7 m in centimetres, in a T-pose. */
const PERSON: Part = {
  name: 'Hips',
  offset: [0, 96, 0],
  parts: [LEFT.leg, RIGHT.leg, { name: 'Spine', offset: [0, 12, 0], parts: [CHEST] }],
};

const FRAMES = 41;
const FRAME_SECONDS = 0.05;

/** Walking on the spot, arms down: degrees about z x y of a joint at a time. One step per second. */
function angles(name: string, seconds: number): readonly [number, number, number] {
  const swing = Math.sin(2 * Math.PI * seconds) * (name.startsWith('Left') ? 1 : -1);
  const left = name.startsWith('Left') ? 1 : -1;
  if (name.endsWith('UpLeg')) return [0, -25 * Math.max(0, swing), 0];
  if (name.endsWith('Leg')) return [0, 50 * Math.max(0, swing), 0];
  if (name.endsWith('Foot')) return [0, -25 * Math.max(0, swing), 0];
  if (/(Left|Right)Arm$/.test(name)) return [-75 * left, 20 * swing, 0];
  return [0, 0, 0];
}

function bvh(): string {
  const lines: string[] = ['HIERARCHY'];
  const names: string[] = [];
  const write = ({ name, offset, parts }: Part, depth: number) => {
    const tab = '\t'.repeat(depth);
    names.push(name);
    const positions = depth === 0 ? '6 Xposition Yposition Zposition' : '3';
    lines.push(`${tab}${depth === 0 ? 'ROOT' : 'JOINT'} ${name}`, `${tab}{`, `${tab}\tOFFSET ${offset.join(' ')}`);
    lines.push(`${tab}\tCHANNELS ${positions} Zrotation Xrotation Yrotation`);
    for (const part of parts ?? []) write(part, depth + 1);
    if (!parts) lines.push(`${tab}\tEnd Site`, `${tab}\t{`, `${tab}\t\tOFFSET 0 0 6`, `${tab}\t}`);
    lines.push(`${tab}}`);
  };
  write(PERSON, 0);
  lines.push('MOTION', `Frames: ${FRAMES}`, `Frame Time: ${FRAME_SECONDS}`);
  for (let f = 0; f < FRAMES; f++) {
    const turns = names.flatMap((name) => angles(name, f * FRAME_SECONDS));
    lines.push(['0', '96', '0', ...turns.map((degrees) => String(Number(degrees.toFixed(6))))].join(' '));
  }
  return `${lines.join('\n')}\n`;
}

type Way = readonly [from: string, to: string];
/** Bones of the source, and the corresponding ones of the walker. */
const BONES: readonly (readonly [Way, Way])[] = (['Left', 'Right'] as const).flatMap((side) => {
  const s = side === 'Left' ? 'l' : 'r';
  const of = (from: string, to: string, own: string, ownTo: string): readonly [Way, Way] => [
    [`${side}${from}`, `${side}${to}`],
    [`${own}_${s}`, `${ownTo}_${s}`],
  ];
  return [
    of('Arm', 'ForeArm', 'upper_arm', 'forearm'),
    of('ForeArm', 'Hand', 'forearm', 'hand'),
    of('UpLeg', 'Leg', 'thigh', 'shin'),
    of('Leg', 'Foot', 'shin', 'foot'),
  ];
});

/** Unit vectors along bones of a character at a time, as drawn; neither placement is rotated. */
function directions(page: Page, character: string, bones: readonly Way[], seconds: number): Promise<number[][]> {
  return page.evaluate(
    async ([name, ways, time]) => {
      window.marrow.seek(time);
      await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
      const joints = window.marrow.characters().find((c) => c.name === name)?.joints ?? [];
      const world = window.marrow.worldMatrices(name);
      const at = (joint: string) => world[joints.findIndex((j) => j.name === joint)].slice(12, 15);
      return ways.map(([from, to]) => {
        const way = at(to).map((v, k) => v - at(from)[k]);
        return way.map((v) => v / Math.hypot(...way));
      });
    },
    [character, bones.map(([from, to]) => [from, to] as const), seconds] as const,
  );
}

const degreesBetween = (a: readonly number[], b: readonly number[]) =>
  (180 / Math.PI) * Math.acos(Math.min(1, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]));

/** Everything that would be saved of the walker and the take. */
const saved = (page: Page) =>
  page.evaluate(() =>
    Promise.all(
      ['walker.skel', 'walker.skin', 'walker_walk.anim', 'walker_blink.morph', 'walker.rig', 'step.bvh'].map((name) =>
        window.marrow.save(name),
      ),
    ),
  );

const matrices = (page: Page, seconds: number) =>
  page.evaluate(async (time) => {
    window.marrow.seek(time);
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    return window.marrow.worldMatrices('walker');
  }, seconds);

const inPage = inOnePage({ walking: true });

const takes = (page: Page) => page.evaluate(() => window.marrow.characters().find((c) => c.name === 'walker')?.takes);

inPage('moves the walker as the take moves, is changed by keyboard, baked, saved and undone', async ({ page }) => {
  await startOver(page);
  await page.evaluate(() => window.marrow.run('sample.walker'));
  const take = bvh();
  await dropFiles(page, [{ name: 'step.bvh', bytes: take }]);
  await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'step'));
  const before = await saved(page);
  const opened = await page.evaluate(() => window.marrow.steps().undo);
  expect(before.at(-1)).toBe(take);

  await page.getByRole('menuitem', { name: 'Edit' }).click();
  await page.getByRole('menuitem', { name: /Retarget take/ }).click();
  const dialog = page.getByRole('dialog', { name: 'Retarget take' });
  const follows = (joint: string) => dialog.getByRole('combobox', { name: `${joint} follows`, exact: true });
  const followed = (joint: string) => follows(joint).evaluate((s: HTMLSelectElement) => s.selectedOptions[0].label);
  await follows('thigh_l').waitFor();
  for (const [joint, source] of [
    ['hips', 'Hips'],
    ['head', 'Head'],
    ['forearm_r', 'RightForeArm'],
    ['shin_l', 'LeftLeg'],
    ['ear_l', '—'],
  ]) {
    await expect.poll(() => followed(joint), { message: joint }).toBe(source);
  }
  // Previewed behind the dialog before applying, without a step.
  await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).not.toContain('Retarget');
  // By keyboard: the ear follows the head. Typing a letter selects a name, as in every list.
  await follows('ear_l').focus();
  await page.keyboard.type('Head');
  await expect.poll(() => followed('ear_l')).toBe('Head');
  await expect.poll(() => dialog.getByRole('row', { name: /^ear_l/ }).textContent()).toContain('set by hand');
  await page.keyboard.press('Backspace');
  await dialog.getByRole('button', { name: 'Apply' }).focus();
  await page.keyboard.press('Enter');
  await dialog.waitFor({ state: 'detached' });
  await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBe('Retarget step to walker');
  // What was made is selected.
  await page
    .getByRole('treeitem', { name: /^walker/, selected: true })
    .first()
    .waitFor();

  // Arms and legs point like the take's. Legs with planted feet may differ slightly.
  const own = BONES.map(([, way]) => way);
  const theirs = BONES.map(([way]) => way);
  for (const seconds of [0, 0.25, 0.6, 0.75, 1.3]) {
    const source = await directions(page, 'step', theirs, seconds);
    const walker = await directions(page, 'walker', own, seconds);
    source.forEach((way, i) => {
      expect(degreesBetween(way, walker[i]), `${own[i].join(' to ')} at ${seconds} s`).toBeLessThan(12);
    });
  }
  // It does move.
  const [up, down] = [await directions(page, 'walker', own, 0.25), await directions(page, 'walker', own, 0.75)];
  expect(degreesBetween(up[2], down[2])).toBeGreaterThan(15);

  // Its own keys have no effect, with a notice; keying is refused with a remedy.
  await page.evaluate(() => window.marrow.run('view.frameAll'));
  await page
    .getByRole('treeitem', { name: /^walker/ })
    .first()
    .click();
  await expect
    .poll(() => page.getByRole('note').filter({ hasText: 'walker is retargeted from step' }).isVisible())
    .toBe(true);
  await page.getByRole('tree').evaluate((tree) => {
    tree.scrollTop = 0;
  });
  await page.getByRole('treeitem').filter({ hasText: 'follows step' }).waitFor();
  await page.keyboard.press('k');
  await page
    .getByText(/walker is retargeted from step.*Bake the retargeting to edit it/)
    .filter({ visible: true })
    .first()
    .waitFor();
  await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBe('Retarget step to walker');
  // An unkeyed change overrides retargeting at that time; then it is discarded, with its step.
  const tx = page.locator('.dof[data-dof="0"]').first();
  await expect.poll(() => tx.getAttribute('data-driver')).toBe('moved');
  await tx.locator('input[type="text"]').fill('0.7');
  await page.keyboard.press('Enter');
  await expect.poll(() => tx.getAttribute('data-driver')).toBe('unkeyed');
  await expect.poll(() => page.evaluate(() => window.marrow.characters()[0].dofs[0])).toBeCloseTo(0.7, 9);
  await page.evaluate(() => window.marrow.seek(1.9));
  await expect.poll(() => tx.getAttribute('data-driver')).toBe('moved');
  await page.evaluate(() => {
    while (window.marrow.steps().undo !== 'Retarget step to walker') window.marrow.undo();
  });

  const times = [0, 0.35, 0.8, 1.75];
  const live: number[][][] = [];
  for (const seconds of times) live.push(await matrices(page, seconds));
  await page.getByRole('note').getByRole('button', { name: 'Bake' }).click();
  await expect.poll(() => takes(page)).toEqual(['walker_walk', 'walker_step']);
  for (const [i, seconds] of times.entries()) {
    expectClose((await matrices(page, seconds)).flat(), live[i].flat(), 1e-6, `baked, at ${seconds} s`);
  }
  // Saved, it plays the same without the page and without the source.
  const [skel, anim] = await page.evaluate(() =>
    Promise.all(['walker.skel', 'walker_step.anim'].map((name) => window.marrow.save(name))),
  );
  const folder = mkdtempSync(join(tmpdir(), 'marrow-baked-'));
  try {
    writeFileSync(join(folder, 'walker.skel'), skel);
    writeFileSync(join(folder, 'walker_step.anim'), anim);
    for (const [i, seconds] of times.entries()) {
      const args = ['pose', 'walker.skel', 'walker_step.anim', '--time', String(seconds)];
      // Joints with world matrices, as in the conformance files.
      const posed = await commandJson<PoseJson>(args, folder);
      expectClose(
        posed.characters[0].joints.flatMap(({ world }) => world),
        live[i].flat(),
        1e-6,
        `saved, at ${seconds} s`,
      );
    }
  } finally {
    rmSync(folder, { recursive: true });
  }

  const undone = await page.evaluate((until) => {
    const steps: (string | undefined)[] = [];
    while (window.marrow.steps().undo !== until && window.marrow.undo()) steps.push(window.marrow.steps().redo);
    return steps;
  }, opened);
  expect(undone).toEqual(['Bake step into walker', 'Retarget step to walker']);
  await expect.poll(() => takes(page)).toEqual(['walker_walk']);
  await expect.poll(() => saved(page)).toEqual(before);
  while (await page.evaluate(() => window.marrow.redo()));
  await expect.poll(() => takes(page)).toEqual(['walker_walk', 'walker_step']);
  expectClose((await matrices(page, times[1])).flat(), live[1].flat(), 1e-6, 'redone');
});

inPage('follows the take as it is cropped or read again, and keeps moving when it is removed', async ({ page }) => {
  await startOver(page);
  await page.evaluate(() => window.marrow.run('sample.walker'));
  const take = bvh();
  await dropFiles(page, [{ name: 'step.bvh', bytes: take }]);
  await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'step'));
  await page.evaluate(async () => {
    const id = (name: string) => window.marrow.characters().find((c) => c.name === name)?.id;
    await window.marrow.run('retarget.set', { character: 'walker', sourceId: id('step') });
  });
  const at = 0.25;
  const live = await matrices(page, at);
  // Cropped to start at 0.5 s: what was at 0.25 s is gone.
  await page.evaluate(() => window.marrow.run('samples.crop', { character: 'step', from: 0.5, to: 1 }));
  await expect.poll(() => matrices(page, at)).not.toEqual(live);
  await page.evaluate(() => window.marrow.undo());
  expectClose((await matrices(page, at)).flat(), live.flat(), 1e-9, 'crop undone');

  const handHeight = async () => {
    const index = await page.evaluate(
      () =>
        window.marrow
          .characters()
          .find((c) => c.name === 'walker')
          ?.joints.findIndex((j) => j.name === 'hand_l') ?? -1,
    );
    return (await matrices(page, 0))[index][13];
  };
  const hanging = await handHeight();
  // Reloaded with raised arms: a T-pose.
  const still = take.split('\n').map((line) => line.replace(/-?75(?=[ \n])/g, '0'));
  await dropFiles(page, [{ name: 'step.bvh', bytes: still.join('\n') }]);
  await expect.poll(handHeight).toBeGreaterThan(hanging + 0.1);
  const raised = await matrices(page, at);
  await expect.poll(() => page.evaluate(() => window.marrow.characters().length)).toBe(2);

  await page.evaluate(() => window.marrow.run('character.remove', { character: 'step' }));
  await expect.poll(() => page.evaluate(() => window.marrow.characters().map((c) => c.name))).toEqual(['walker']);
  expectClose((await matrices(page, at)).flat(), raised.flat(), 1e-9, 'the take removed');
  await page.evaluate(() => {
    window.marrow.undo();
    window.marrow.undo();
  });
  expectClose((await matrices(page, at)).flat(), live.flat(), 1e-9, 'both undone');
});
