/** The pictures of docs/: what the page is made to show in each. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { CATALOGUE } from '../../src/teaching/catalogue/all.ts';
import { type Program, RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { command } from '../helpers/command.ts';
import { characterOf, OWN } from '../teaching/lesson-files.ts';
import { numbersBy } from '../teaching/planted.ts';

export interface Shot {
  /** Of the file, without its extension. */
  readonly name: string;
  /** The example that the page opens with. */
  readonly example: 'walker' | 'crawler' | 'joints' | 'tangents';
  /** CSS pixels; default 1200 × 750. */
  readonly size?: { readonly width: number; readonly height: number };
  /** Default dark. */
  readonly theme?: 'light' | 'dark';
  /** Brings the page there. */
  act(page: Page): Promise<void>;
  /** Makes a GIF, which is taken instead of a screenshot. */
  film?(page: Page): Promise<Uint8Array>;
}

const run = (page: Page, id: string, args?: Readonly<Record<string, unknown>>) =>
  page.evaluate(async ({ id, args }) => void (await window.marrow.run(id, args)), { id, args });
const seek = (page: Page, seconds: number) => page.evaluate((time) => window.marrow.seek(time), seconds);
const tab = (page: Page, name: string) => run(page, `page.tab.${name}`);
const open = (page: Page, files: readonly { readonly name: string; readonly content: string }[]) =>
  page.evaluate(async (given) => void (await window.marrow.open(given)), files);
/** Its name in docs/pictures/. */
export const fileOf = ({ name, film }: Shot): string => `${name}.${film ? 'gif' : 'webp'}`;

/** As files that are dropped: a script opens them, however many there are, and a drop of many is a review. */
const drop = (page: Page, files: readonly { readonly name: string; readonly content: string }[]) =>
  page.evaluate((given) => {
    const dataTransfer = new DataTransfer();
    for (const { name, content } of given) dataTransfer.items.add(new File([content], name));
    for (const type of ['dragenter', 'dragover', 'drop']) {
      document.body.dispatchEvent(new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }));
    }
  }, files);

/** Selects a joint by its row, which the outliner has only while it shows it. */
async function select(page: Page, name: string): Promise<void> {
  const row = page.getByRole('treeitem', { name, exact: false }).first();
  await page.getByRole('treeitem').first().hover();
  while ((await row.count()) === 0) {
    await page.mouse.wheel(0, 100);
    await page.waitForTimeout(100);
  }
  await row.click();
  // Onto nothing that would show a tooltip.
  const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
  await page.mouse.move(width - 4, height - 4);
}

/** The walker's walk as a motion capture. */
async function capture(): Promise<string> {
  const folder = mkdtempSync(join(tmpdir(), 'marrow-pictures-'));
  try {
    const samples = fileURLToPath(new URL('../../public/samples/', import.meta.url));
    await command(['convert', `${samples}walker.skel`, `${samples}walker_walk.anim`, join(folder, 'walk.bvh')]);
    return readFileSync(join(folder, 'walk.bvh'), 'utf8');
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** World matrices of the walker by a program that makes a mistake of the catalogue. */
function dump(code: string): string {
  const walker = characterOf(...OWN.walker);
  const names = walker.skeleton?.joints.map(({ name }) => name) ?? [];
  const textBy = (program: Program) =>
    numbersBy(walker, program, 'world')
      .frames.map(({ time, world }) => {
        const rows = names.map((name, i) => `${name}: ${[...(world?.subarray(16 * i, 16 * i + 16) ?? [])].join(' ')}`);
        return `time ${time}\n${rows.join('\n')}\n`;
      })
      .join('');
  const right = textBy(RIGHT_PROGRAM);
  const variants = CATALOGUE.find((mistake) => mistake.code === code)?.variants ?? [];
  const wrong = variants.map((variant) => textBy(variant.apply(RIGHT_PROGRAM))).find((text) => text !== right);
  if (wrong === undefined) throw new Error(`No mistake ${code} shows.`);
  return wrong;
}

/** 24 takes of the walk, of which some have what a review finds. */
async function takes(): Promise<readonly { readonly name: string; readonly content: string }[]> {
  const [head = '', motion = ''] = (await capture()).split(/(?<=Frame Time:.*\n)/);
  const frames = motion.trimEnd().split('\n').slice(0, 60);
  const header = head.replace(/Frames:.*/, `Frames: ${frames.length}`);
  const changes: readonly ((rows: string[]) => string[])[] = [
    (rows) => rows,
    (rows) => rows.map((line, i) => (i === 30 ? line.replace(/^\S+/, (x) => String(Number(x) + 0.4)) : line)),
    (rows) => rows.map((line, i) => (i > 20 && i < 40 ? (rows[20] ?? line) : line)),
    (rows) => rows.toReversed(),
  ];
  const names = ['walk', 'stroll', 'march', 'idle', 'turn', 'stop'];
  return names.flatMap((name, n) =>
    changes.map((change, i) => ({
      name: `${name}_${i + 1}.bvh`,
      content: `${header}${change(frames.slice(0, 60 - 4 * n)).join('\n')}\n`.replace(
        /Frames:.*/,
        `Frames: ${60 - 4 * n}`,
      ),
    })),
  );
}

export const SHOTS: readonly Shot[] = [
  {
    name: 'walk',
    example: 'walker',
    async act(page) {
      await run(page, 'draw.inPlace');
      await run(page, 'view.frameAll');
    },
    async film(page) {
      const base64 = await page.evaluate(async () => {
        const made = await window.marrow.video({
          format: 'gif',
          width: 360,
          height: 360,
          framesPerSecond: 10,
          range: [0, 0.8],
          hasGrid: false,
          hasBackground: true,
          hasTools: false,
        });
        return btoa(
          Array.from(new Uint8Array((await made?.arrayBuffer()) ?? []), (c) => String.fromCharCode(c)).join(''),
        );
      });
      return Buffer.from(base64, 'base64');
    },
  },
  {
    name: 'workbench',
    example: 'walker',
    size: { width: 1440, height: 900 },
    async act(page) {
      await seek(page, 0.6);
      await select(page, 'upper_arm_l');
    },
  },
  {
    name: 'first-pose',
    example: 'walker',
    async act(page) {
      await seek(page, 0.6);
      await select(page, 'upper_arm_l');
      await run(page, 'pose.setDofs', { dofs: [{ index: 38, value: 0.9 }] });
    },
  },
  {
    name: 'cycle',
    example: 'walker',
    async act(page) {
      await seek(page, 2);
      await select(page, 'upper_arm_l');
      await run(page, 'pose.setDofs', { dofs: [{ index: 38, value: 0.9 }] });
      await page.keyboard.press('k');
      await page.getByRole('dialog').waitFor();
    },
  },
  {
    name: 'curves',
    example: 'tangents',
    theme: 'light',
    async act(page) {
      await tab(page, 'curves');
      await select(page, 'wrist');
      await page.locator('.curve-plot').first().hover();
      await page.keyboard.press('Control+a');
    },
  },
  {
    name: 'why',
    example: 'tangents',
    async act(page) {
      await tab(page, 'curves');
      await seek(page, 0.5);
      await select(page, 'wrist');
      await run(page, 'timeline.showsWhy');
      await page.locator('.why').waitFor();
      // The second key of rz.
      const key = await page.evaluate(() => {
        const [, { time, value }] = window.marrow.keys(14);
        return window.marrow.placeOf(14, time, value);
      });
      if (key) await page.mouse.click(key.x, key.y);
    },
  },
  {
    name: 'dope-sheet',
    example: 'crawler',
    async act(page) {
      await tab(page, 'dope');
      await page.locator('.dope').first().waitFor();
    },
  },
  {
    name: 'joint-weights',
    example: 'walker',
    async act(page) {
      await seek(page, 0.6);
      await select(page, 'spine');
      await run(page, 'draw.skin.heat');
      await run(page, 'view.frameSelection');
    },
  },
  {
    name: 'steps',
    example: 'walker',
    theme: 'light',
    async act(page) {
      await seek(page, 0.6);
      await select(page, 'forearm_l');
      await tab(page, 'steps');
    },
  },
  {
    name: 'source',
    example: 'walker',
    async act(page) {
      await seek(page, 0.6);
      await select(page, 'head');
      await tab(page, 'source');
    },
  },
  {
    name: 'ik',
    example: 'crawler',
    async act(page) {
      await run(page, 'page.timeline');
      await run(page, 'posing.ik');
      // The tips of its six legs stay, and its body is dragged up.
      const legs = [10, 13, 16, 19, 22, 25];
      for (const [i, joint] of legs.entries())
        await run(page, 'ik.pin', { joint, point: [i < 3 ? 0.43 : -0.43, 0, 0] });
      const body = await page.evaluate(() => {
        const matrix = window.marrow.worldMatrices()[2];
        return window.marrow.pointOnPage([matrix[12], matrix[13], matrix[14]]);
      });
      if (!body) throw new Error('The body is not in view.');
      await page.mouse.move(body.x, body.y);
      await page.mouse.down();
      await page.mouse.move(body.x - 6, body.y - 22, { steps: 4 });
    },
  },
  {
    name: 'layers',
    example: 'walker',
    size: { width: 1360, height: 800 },
    async act(page) {
      await seek(page, 1.6);
      await run(page, 'view.front');
      await tab(page, 'takes');
      await run(page, 'layers.add', { name: 'wave' });
      await select(page, 'upper_arm_l');
      await run(page, 'layers.add', { name: 'lean', mode: 'override' });
      await run(page, 'layers.keyWeight', { layer: 1, weight: 0.4 });
      await run(page, 'layers.activate', { layer: 0 });
      const hand = await page.evaluate(() => {
        const at = window.marrow.characters()[0].joints.findIndex(({ name }) => name === 'hand_l');
        const matrix = window.marrow.worldMatrices()[at];
        return window.marrow.pointOnPage([matrix[12], matrix[13], matrix[14]]);
      });
      if (!hand) throw new Error('The hand is not in view.');
      await page.mouse.move(hand.x, hand.y);
      await page.mouse.down();
      await page.mouse.move(hand.x + 40, hand.y - 120, { steps: 8 });
      await page.mouse.up();
      await run(page, 'keys.forMoment', { easeIn: 0.5, easeOut: 0.5 });
    },
  },
  {
    name: 'pose-library',
    example: 'walker',
    size: { width: 1360, height: 800 },
    async act(page) {
      for (const time of [0, 0.2, 0.4, 0.6]) {
        await seek(page, time);
        await run(page, 'pose.keep');
      }
      await tab(page, 'poses');
    },
  },
  {
    name: 'joint-types',
    example: 'joints',
    theme: 'light',
    async act(page) {
      await seek(page, 1.2);
      await run(page, 'view.frameAll');
    },
  },
  {
    name: 'rig',
    example: 'crawler',
    async act(page) {
      await run(page, 'rigging.mode');
    },
  },
  {
    name: 'motion-path',
    example: 'walker',
    async act(page) {
      await seek(page, 3.2);
      await select(page, 'foot_l');
      await run(page, 'draw.trail');
      await run(page, 'view.ghosts', { at: 'frames', every: 6, before: 3, after: 3, of: 'skeleton' });
    },
  },
  {
    name: 'measure',
    example: 'walker',
    async act(page) {
      await seek(page, 1);
      await select(page, 'foot_l');
      await tab(page, 'measure');
    },
  },
  {
    name: 'compare',
    example: 'walker',
    async act(page) {
      await open(page, [{ name: 'mine.txt', content: dump('rotation-order') }]);
      await page.locator('.compare-banner').waitFor();
    },
  },
  {
    name: 'review',
    example: 'walker',
    theme: 'light',
    async act(page) {
      await drop(page, await takes());
      await tab(page, 'review');
      // Once all are checked.
      await page.getByText('24 takes', { exact: true }).waitFor();
    },
  },
  {
    name: 'problem',
    example: 'crawler',
    async act(page) {
      await open(page, [
        { name: 'mine.skel', content: 'balljoint root {\n  offset 0 one 0\n  boxmin -0.1 -0.1 -0.1\n}\n' },
      ]);
      await page.locator('.message-line').waitFor();
    },
  },
  {
    name: 'glb',
    example: 'crawler',
    async act(page) {
      await run(page, 'save.glb');
      await page.getByRole('dialog').locator('button:enabled', { hasText: 'Save' }).waitFor();
    },
  },
];
