/** What `npm run attack` is asked for. */
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { reasonOf } from '../../src/cli/reason.ts';
import type { Attack } from './attack.ts';
import { ATTACKS } from './attacks.ts';
import { isSubject, SUBJECTS } from './readers/subjects.ts';

export interface AttackOptions {
  readonly attacks: readonly Attack[];
  /** For all of them. */
  readonly minutes: number;
  readonly seed: number;
  /** The text of a reproducer. */
  readonly replay: string | undefined;
  /** Extensions of files, for the attack on readers. */
  readonly files: readonly string[] | undefined;
  /** One of so many inputs of readers is more than read. */
  readonly wholeOneIn: number;
}

/** Instead of options: what to print. */
export interface Usage {
  readonly usage: string;
  /** What is wrong is its first line; otherwise it was asked for. */
  readonly isWrong: boolean;
}

const WIDTH = Math.max(...ATTACKS.map(({ name }) => name.length));
const USAGE = `Usage: npm run attack -- [--minutes N] [--only NAME]… [--seed INTEGER] [--replay FILE] [--files EXTENSION]…
                         [--whole-one-in COUNT]

${ATTACKS.map(({ name, shows }) => `  ${name.padEnd(WIDTH)}  ${shows}`).join('\n')}`;

/** Whole numbers of 32 bits. */
const MAX_SEED = 2 ** 31;

/** The usage where it is asked for, or where the arguments are wrong, beneath a sentence that says why. */
export function optionsOf(args: readonly string[]): AttackOptions | Usage {
  try {
    const { values } = parseArgs({
      args: [...args],
      options: {
        minutes: { type: 'string', default: '10' },
        only: { type: 'string', multiple: true },
        seed: { type: 'string' },
        replay: { type: 'string' },
        files: { type: 'string', multiple: true },
        'whole-one-in': { type: 'string', default: '1' },
        help: { type: 'boolean', short: 'h' },
      },
    });
    const { only = [], files } = values;
    if (values.help) return { usage: USAGE, isWrong: false };
    const names = ATTACKS.map(({ name }) => name);
    const unknown = only.find((name) => !names.includes(name));
    if (unknown !== undefined) throw new Error(`There is no attack "${unknown}".`);
    const minutes = Number(values.minutes);
    if (!(minutes > 0)) throw new Error(`--minutes must be greater than 0, found ${values.minutes}.`);
    const seed = values.seed === undefined ? Math.floor(Math.random() * MAX_SEED) : Number(values.seed);
    if (!Number.isInteger(seed)) throw new Error(`--seed must be a whole number, found ${values.seed}.`);
    const attacks = ATTACKS.filter(({ name }) => only.length === 0 || only.includes(name));
    const strange = files?.find((extension) => !isSubject(extension));
    if (strange !== undefined) throw new Error(`--files must be of ${SUBJECTS.join(' ')}, found ${strange}.`);
    const replay = values.replay === undefined ? undefined : textOf(values.replay);
    const wholeOneIn = Number(values['whole-one-in']);
    if (!(Number.isInteger(wholeOneIn) && wholeOneIn > 0))
      throw new Error(`--whole-one-in must be a whole number, found ${values['whole-one-in']}.`);
    return { attacks, minutes, seed, replay, files, wholeOneIn };
  } catch (error) {
    // Those of `parseArgs` are sentences too.
    return { usage: `${error instanceof Error ? error.message : String(error)}\n${USAGE}`, isWrong: true };
  }
}

function textOf(path: string): string {
  try {
    return readFileSync(path, 'utf8');
  } catch (error) {
    throw new Error(`--replay: ${path} could not be read: ${reasonOf(error)}.`);
  }
}
