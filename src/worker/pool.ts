import { type JobOptions, type Runs, WorkerClient, type WorkerLike } from './client.ts';
import type { Jobs, PageJob } from './protocol.ts';

/**
 * Which jobs share a worker. Cancelling one ends its worker and with it all jobs there, so what is cancelled any time,
 * or runs for long, has its own: all others.
 */
const LANES: { readonly [K in PageJob]?: string } = {
  parse: 'open',
  unpack: 'open',
  kit: 'open',
  changes: 'edit',
  check: 'edit',
};

/** Runs all jobs of the page; workers are started for their first jobs. */
export class WorkerPool implements Runs<PageJob> {
  private readonly clients = new Map<string, WorkerClient>();

  constructor(private readonly spawn: () => WorkerLike) {}

  /** As `WorkerClient.run`. */
  run<K extends PageJob>(job: K, input: Jobs[K]['takes'], options?: JobOptions): Promise<Jobs[K]['gives']> {
    const lane = LANES[job] ?? job;
    const client = this.clients.get(lane) ?? new WorkerClient(this.spawn);
    this.clients.set(lane, client);
    return client.run(job, input, options);
  }
}
