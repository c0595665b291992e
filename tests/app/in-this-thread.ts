import { testKit } from '../../src/teaching/kit/kit.ts';
import { changesOf, checkText } from '../../src/worker/changes.ts';
import { WorkerClient } from '../../src/worker/client.ts';
import { compareDumps } from '../../src/worker/compare-program.ts';
import { exchangeFileOf } from '../../src/worker/exchange.ts';
import { parse } from '../../src/worker/parse.ts';
import type { Jobs } from '../../src/worker/protocol.ts';
import { unpackTakes } from '../../src/worker/review.ts';
import { mapSourceOf } from '../../src/worker/source.ts';
import { webPageOf } from '../../src/worker/web-page.ts';

/** Runs the worker's jobs in this thread. */
export class InThisThread extends WorkerClient {
  constructor() {
    super(() => {
      throw new Error('No worker is needed.');
    });
  }
  override async run<K extends keyof Jobs>(_job: K, input: Jobs[K]['takes']): Promise<Jobs[K]['gives']> {
    const nobody = () => undefined;
    if (input === undefined) return testKit();
    if ('blob' in input) return mapSourceOf(input, nobody);
    if ('file' in input) return changesOf(input);
    if ('options' in input) return exchangeFileOf(input, nobody);
    if ('characters' in input) return webPageOf(input);
    if ('zip' in input) return unpackTakes(input);
    if ('edited' in input) return checkText(input, nobody);
    return 'files' in input ? parse(input, nobody) : compareDumps(input, nobody);
  }
}
