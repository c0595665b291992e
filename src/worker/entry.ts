/** The page's worker: the code of each job. */
import { provideLayers } from '../evaluate/layers.ts';
import { testKit } from '../teaching/kit/kit.ts';
import { compareDumps } from './compare-program.ts';
import { parse } from './parse.ts';
import { partsOf } from './parts.ts';
import type { PageJob, Progress } from './protocol.ts';
import { serve } from './serve.ts';
import { mapSourceOf } from './source.ts';

// Characters and takes that are passed on may have layers.
provideLayers();
serve<PageJob>(async (data, post) => {
  const { id } = data;
  const onProgress = (progress: Progress) => post({ id, kind: 'progress', progress });
  switch (data.job) {
    case 'parse': {
      const output = await parse(data.input, onProgress);
      for (const { part, transfer } of partsOf(output)) post({ id, kind: 'part', part }, transfer);
      return { id, kind: 'done', job: data.job, output: { ...output, files: [], facts: [] } };
    }
    case 'source':
      return { id, kind: 'done', job: data.job, output: await mapSourceOf(data.input, onProgress) };
    case 'changes': {
      const { changesOf } = await changes();
      return { id, kind: 'done', job: data.job, output: await changesOf(data.input) };
    }
    case 'check': {
      const { checkText } = await changes();
      return { id, kind: 'done', job: data.job, output: await checkText(data.input, onProgress) };
    }
    case 'review': {
      const { reviewTakes } = await import('./review.ts');
      return { id, kind: 'done', job: data.job, output: await reviewTakes(data.input) };
    }
    case 'unpack': {
      const { unpackTakes } = await import('./review.ts');
      return { id, kind: 'done', job: data.job, output: await unpackTakes(data.input) };
    }
    case 'exchange': {
      const { exchangeFileOf } = await import('./exchange.ts');
      return { id, kind: 'done', job: data.job, output: await exchangeFileOf(data.input, onProgress) };
    }
    case 'webPage': {
      const { webPageOf } = await import('./web-page.ts');
      return { id, kind: 'done', job: data.job, output: await webPageOf(data.input) };
    }
    case 'kit':
      return { id, kind: 'done', job: data.job, output: testKit() };
    case 'compare':
      return { id, kind: 'done', job: data.job, output: compareDumps(data.input, onProgress) };
  }
});

/** With all that writes files, which reading needs nothing of. */
const changes = () => import('./changes.ts');
