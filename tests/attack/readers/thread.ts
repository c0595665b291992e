/** Reads one input after the other, in a thread that can be ended in the middle of one. */
import { parentPort, workerData } from 'node:worker_threads';
import { faultsOf } from './check.ts';
import { Inputs } from './inputs.ts';
import type { Found, Orders } from './protocol.ts';
import { shrunk } from './shrink.ts';

const SHRINK_MS = 3000;
/** More of a kind from one subject say nothing new, and take long to shrink. */
const MAX_OF_A_KIND = 2;

// As the attack starts it.
const { corpus, seed, from, wholeOneIn, at: shared }: Orders = workerData;
const at = new Int32Array(shared);
const inputs = new Inputs(corpus, seed);
const found = new Map<string, number>();

for (let index = from; ; index++) {
  Atomics.store(at, 0, index);
  const input = inputs.at(index);
  const faults = await faultsOf(input, index % wholeOneIn === 0);
  for (const fault of faults) {
    const key = `${input.subject} ${fault.kind}`;
    const count = (found.get(key) ?? 0) + 1;
    found.set(key, count);
    const small = count > MAX_OF_A_KIND ? input : await shrunk(input, fault, SHRINK_MS);
    const message: Found = { index, fault, input: small };
    parentPort?.postMessage(message);
  }
}
