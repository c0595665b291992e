/** Checks the inputs that it is sent, one after the other, and answers each with its faults. */
import { parentPort } from 'node:worker_threads';
import { faultsOf } from './check.ts';
import type { Input } from './inputs.ts';

parentPort?.on('message', (input: Input) => {
  void faultsOf(input).then((faults) => parentPort?.postMessage(faults));
});
