/**
 * Mutated files of all kinds, for all readers. They are read in a thread, which is watched: one that hangs, or takes
 * all memory, is ended, and the next begins behind the input that did it.
 */
import { once } from 'node:events';
import type { Attack, Attempt } from '../attack.ts';
import { corpus, type Seed } from './corpus.ts';
import { Inputs } from './inputs.ts';
import type { Found, Orders } from './protocol.ts';
import { buildThread, startThread } from './start-thread.ts';

const LOOK_MS = 500;
/**
 * An input is slow above a second of the processor's time, which the thread measures. In this one's time, too: the
 * machine may be busy, or stand still. Far more than that, since memory is measured by hundreds of full collections.
 */
const HANGS_MS = 180_000;
/** Of anyone's: what waits for nothing takes no time of the processor. */
const STALLS_MS = 300_000;

export const readers: Attack = {
  name: 'readers',
  shows:
    'mutated files of all kinds are read or refused: in time, in bounds, the same in pieces, the same when written',
  async run(attempt) {
    const script = await buildThread('thread');
    const { files } = attempt;
    const seeds = corpus().filter(({ subject }) => !files || files.includes(subject));
    const counts = new Map<string, number>();
    const begun = performance.now();
    let next = 0;
    do next = await runThread(attempt, script, seeds, next, counts);
    while (attempt.goesOn());
    const seconds = (performance.now() - begun) / 1000;
    attempt.note(`${Math.round(next / seconds)} per second`);
    attempt.note([...counts].map(([subject, count]) => `${subject} ${count}`).join(' '));
  },
};

/** Until time is over or the thread ends. Returns the first input that was not read. */
async function runThread(
  attempt: Attempt,
  script: string,
  seeds: readonly Seed[],
  from: number,
  counts: Map<string, number>,
) {
  const shared = new SharedArrayBuffer(4);
  const at = new Int32Array(shared);
  at[0] = from;
  const orders: Orders = { corpus: seeds, seed: attempt.seed, from, wholeOneIn: attempt.wholeOneIn ?? 1, at: shared };
  const inputs = new Inputs(seeds, attempt.seed);
  const thread = startThread(script, orders);
  let ended: unknown;
  thread.on('error', (error) => {
    ended = error;
  });
  thread.on('message', ({ index, fault, input }: Found) => {
    const what = `input ${index}, .${input.subject}, ${fault.kind}: ${fault.what.slice(0, 2000)}`;
    attempt.gaveWay(what, { extension: input.subject, content: input.bytes });
  });
  const isOver = new Promise<void>((resolve) => thread.once('exit', () => resolve()));
  await once(thread, 'online');
  let counted = from;
  const count = (until: number) => {
    attempt.tried(until - counted);
    for (; counted < until; counted++) {
      const subject = inputs.subjectAt(counted);
      counts.set(subject, (counts.get(subject) ?? 0) + 1);
    }
  };
  const blame = (what: string) => {
    const input = inputs.at(at[0]);
    attempt.gaveWay(`input ${at[0]}, .${input.subject}: ${what}`, { extension: input.subject, content: input.bytes });
    count(at[0] + 1);
  };
  let [seen, sinceMs, since] = [-1, performance.now(), process.cpuUsage()];
  while (attempt.goesOn()) {
    await Promise.race([isOver, new Promise((resolve) => setTimeout(resolve, LOOK_MS))]);
    if (ended !== undefined) {
      blame(`the thread ended: ${String(ended)}`);
      return counted;
    }
    count(at[0]);
    if (at[0] !== seen) {
      [seen, sinceMs, since] = [at[0], performance.now(), process.cpuUsage()];
      continue;
    }
    const { user, system } = process.cpuUsage(since);
    const workedMs = (user + system) / 1000;
    const isStalled = performance.now() - sinceMs > STALLS_MS;
    if (isStalled || workedMs > HANGS_MS) {
      await thread.terminate();
      blame(isStalled ? `waits for more than ${STALLS_MS / 1000} s` : `hangs for more than ${HANGS_MS / 1000} s`);
      return counted;
    }
  }
  await thread.terminate();
  count(at[0]);
  return counted;
}
