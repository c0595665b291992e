/** What `npm run bench -- gpu` is asked for. */
import { existsSync } from 'node:fs';
import { parseArgs } from 'node:util';
import type { Usage } from '../../attack/options.ts';
import { SCENE_NAMES } from './scenes/scenes.ts';

export interface GpuOptions {
  /** Path of the browser; absent: the one that tests use. */
  readonly chromium: string | undefined;
  readonly headed: boolean;
  /** Names of scenes, in the order of the table. */
  readonly scenes: readonly string[];
  readonly seconds: number;
  readonly shadow: boolean;
  /** Of the browser; none: those that lead to a GPU are found. */
  readonly flags: readonly string[];
}

const OPTIONS = {
  chromium: { type: 'string', value: 'PATH', does: 'the browser, instead of the one that tests use' },
  headed: { type: 'boolean', value: '', does: 'in a window' },
  scenes: { type: 'string', value: 'A,B', does: `some of ${SCENE_NAMES.join(', ')}` },
  seconds: { type: 'string', value: 'N', does: 'how long each scene is measured; 3 if not given' },
  'no-shadow': { type: 'boolean', value: '', does: 'without shadows, here and there' },
  flag: {
    type: 'string',
    value: 'FLAG',
    does: 'of the browser, as --flag=--use-angle=gl; may be repeated',
    multiple: true,
  },
  help: { type: 'boolean', value: '', does: 'this' },
} as const;

const HEADS = Object.entries(OPTIONS).map(([name, { value, does }]) => [`--${name} ${value}`, does] as const);
const WIDTH = Math.max(...HEADS.map(([head]) => head.length));
const USAGE = `Usage: npm run bench -- gpu [OPTION]…

Frames of the page beside three.js alone with the same work, on a GPU.

${HEADS.map(([head, does]) => `  ${head.padEnd(WIDTH)}  ${does}`).join('\n')}`;

/** The usage where it is asked for, or where the arguments are wrong, beneath a sentence that says why. */
export function optionsOf(args: readonly string[]): GpuOptions | Usage {
  try {
    const { values } = parseArgs({ args: [...args], options: OPTIONS });
    if (values.help) return { usage: USAGE, isWrong: false };
    const asked = values.scenes?.split(',') ?? SCENE_NAMES;
    const unknown = asked.find((name) => !SCENE_NAMES.includes(name));
    if (unknown !== undefined) throw new Error(`There is no scene "${unknown}".`);
    const seconds = Number(values.seconds ?? 3);
    if (!(seconds > 0)) throw new Error(`--seconds must be greater than 0, found ${values.seconds}.`);
    const { chromium } = values;
    if (chromium !== undefined && !existsSync(chromium)) throw new Error(`--chromium: there is no file ${chromium}.`);
    return {
      chromium,
      headed: values.headed ?? false,
      scenes: SCENE_NAMES.filter((name) => asked.includes(name)),
      seconds,
      shadow: !values['no-shadow'],
      flags: values.flag ?? [],
    };
  } catch (error) {
    // Those of `parseArgs` are sentences too.
    return { usage: `${error instanceof Error ? error.message : String(error)}\n${USAGE}`, isWrong: true };
  }
}
