/**
 * Frames of the built page beside three.js alone with the same work, on a GPU:
 *
 *     npm run bench -- gpu
 *     npm run bench -- gpu --scenes walkers,morphs --seconds 10
 *
 * Prints what it runs on. Without a GPU it measures a smaller set, which says nothing about one.
 */
import { env } from 'node:process';
import { fileURLToPath } from 'node:url';
import { serveFolder } from '../../helpers/server.ts';
import { type Drawing, openDrawing } from './drawing.ts';
import { type GpuOptions, optionsOf } from './options.ts';
import { Pages } from './pages.ts';
import { builtPeer } from './peer/build.ts';
import { FULL, SMALL, scenesOf } from './scenes/scenes.ts';
import { type Row, tableOf } from './table.ts';

const DIST = fileURLToPath(new URL('../../../dist', import.meta.url));

/** Returns the exit code: 1 if a scene could not be measured. @param build makes the page */
export async function run(args: readonly string[], build: () => boolean): Promise<number> {
  const options = optionsOf(args);
  if ('usage' in options) {
    const { usage, isWrong } = options;
    (isWrong ? console.error : console.log)(usage);
    return isWrong ? 2 : 0;
  }
  if (options.chromium !== undefined) env.MARROW_CHROMIUM = options.chromium;
  if (!build()) return 1;
  const drawing = await openDrawing(options);
  try {
    console.log(described(drawing));
    return await compared(drawing, options);
  } finally {
    await drawing.browser.close();
  }
}

function described({ renderer, userAgent, flags, isSoftware }: Drawing): string {
  const lines = [`Renderer: ${renderer}`, `Browser:  ${userAgent}`, `Flags:    ${flags.join(' ')}`];
  if (isSoftware) {
    lines.push('There is no GPU: all is drawn in software. Small scenes follow; their times say nothing about a GPU.');
  }
  return lines.join('\n');
}

async function compared({ browser, isSoftware }: Drawing, { scenes, seconds, shadow }: GpuOptions): Promise<number> {
  const server = await serveFolder(DIST, '/');
  const pages = new Pages(browser, server, await builtPeer(), seconds, shadow);
  try {
    const reference = await pages.reference();
    const floor = await pages.threeAlone({ kind: 'empty' }, reference);
    const rows: Row[] = [];
    const failures: string[] = [];
    for (const scene of scenesOf(isSoftware ? SMALL : FULL).filter(({ name }) => scenes.includes(name))) {
      console.log(`${scene.label} …`);
      const attempt = <T>(who: string, measured: Promise<T>) =>
        measured.catch((error) => {
          failures.push(`${scene.label}, ${who}: ${error instanceof Error ? error.message : error}`);
          return undefined;
        });
      const page = await attempt('Marrow', pages.marrow(scene));
      const peer = scene.peer && (await attempt('three.js alone', pages.threeAlone(scene.peer, reference)));
      rows.push({ label: scene.label, page: page?.frames, peer, openingMs: page?.openingMs });
    }
    const shadows = shadow ? 'with shadows' : 'without shadows';
    console.log(`\nMilliseconds of a frame, ${shadows}: the median, and in brackets the 95th percentile.\n`);
    console.log(tableOf(rows, floor));
    for (const failure of failures) console.error(failure);
    return failures.length > 0 ? 1 : 0;
  } finally {
    await server.close();
  }
}
