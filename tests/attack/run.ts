/**
 * Attacks that take longer than tests may. Each has an equal share of the time, and prints its seed.
 *
 *     npm run build && npm run attack -- --minutes 20
 *     npm run attack -- --only lost-context --seed 169
 *     npm run attack -- --only random-walk --replay tests/repro/random-walk-….json
 *     npm run attack -- --only readers --files npz --files amc --whole-one-in 16
 *
 * Those on the page need the built page. Exits with 1 if anything gave way; what did it is kept in tests/repro/.
 */
import { createHash } from 'node:crypto';
import { mkdirSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { type Attack, type Attempt, chanceOf, type Reproducer } from './attack.ts';
import { optionsOf } from './options.ts';

const REPRO = fileURLToPath(new URL('../repro/', import.meta.url));
/** More of the same say nothing new. */
const MAX_TOLD = 20;

interface Row {
  readonly name: string;
  readonly seed: number;
  readonly tries: number;
  readonly broken: number;
  readonly seconds: number;
  readonly figures: string;
}

/** Runs the attacks that the arguments ask for. Returns the exit code. */
export async function run(args: readonly string[]): Promise<number> {
  const options = optionsOf(args);
  if ('usage' in options) {
    const { usage, isWrong } = options;
    (isWrong ? console.error : console.log)(usage);
    return isWrong ? 2 : 0;
  }
  const { attacks, minutes, seed, replay, files, wholeOneIn } = options;
  const rows: Row[] = [];
  for (const attack of attacks) {
    console.log(`${attack.name}, seed ${seed}: ${attack.shows}`);
    rows.push(await runOne(attack, { seed, replay, files, wholeOneIn }, (minutes * 60_000) / attacks.length));
  }
  console.table(rows.map(({ seconds, ...row }) => ({ ...row, seconds: Math.round(seconds) })));
  return rows.every(({ broken }) => broken === 0) ? 0 : 1;
}

async function runOne(
  { name, run }: Attack,
  given: Pick<Attempt, 'seed' | 'replay' | 'files' | 'wholeOneIn'>,
  budgetMs: number,
): Promise<Row> {
  const begun = performance.now();
  const figures: string[] = [];
  let [tries, broken, asked] = [0, 0, 0];
  const gaveWay = (what: string, reproducer?: Reproducer) => {
    broken++;
    if (broken > MAX_TOLD) return;
    console.error(`  gave way after ${tries} tries: ${what}`);
    if (reproducer) console.error(`  kept as ${keep(name, reproducer)}`);
  };
  try {
    await run({
      ...given,
      ...chanceOf(given.seed),
      goesOn: () => asked++ === 0 || performance.now() - begun < budgetMs,
      tried: (count = 1) => {
        tries += count;
      },
      gaveWay,
      note: (figure) => void figures.push(figure),
    });
  } catch (error) {
    gaveWay(error instanceof Error ? (error.stack ?? error.message) : String(error));
  }
  const seconds = (performance.now() - begun) / 1000;
  return { name, seed: given.seed, tries, broken, seconds, figures: figures.join(', ') };
}

/** The same input has the same name. */
function keep(name: string, { extension, content }: Reproducer): string {
  const file = `${name}-${createHash('sha256').update(content).digest('hex').slice(0, 12)}.${extension}`;
  mkdirSync(REPRO, { recursive: true });
  writeFileSync(`${REPRO}${file}`, content);
  return `tests/repro/${file}`;
}
