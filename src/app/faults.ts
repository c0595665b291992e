/**
 * Errors that nobody caught, and pictures that can't be drawn. Each is told once, however often it comes back, with
 * what can be done: save everything, and copy what a report needs.
 */
import type { Messages } from '../ui/state/messages.ts';
import { onDemand } from '../ui/state/on-demand.ts';
import type { FileActions } from '../ui/state/workbench.ts';

export interface FaultsParts {
  readonly messages: Messages;
  readonly files: Pick<FileActions, 'saveEverything' | 'saveText'>;
}

/** The rest is only in the report. */
const MAX_TOLD = 8;

/** More would be the same ones again. */
const MAX_KNOWN = 64;

export class Faults {
  /** Times that each came, by its text. */
  private readonly known = new Map<string, number>();

  constructor(private readonly parts: FaultsParts) {}

  /** @param what begins the message: `The picture can’t be drawn.` */
  tell(what: string, error: unknown): void {
    const { known, parts } = this;
    const detail = error instanceof Error ? (error.stack ?? error.message) : String(error);
    const text = `${what} ${detail}`;
    const times = known.get(text) ?? 0;
    if (times > 0 || known.size < MAX_KNOWN) known.set(text, times + 1);
    if (times > 0 || known.size > MAX_TOLD) return;
    const message = error instanceof Error ? error.message : detail;
    parts.messages.fault(`${what} ${message.split('\n')[0].slice(0, 200)}`, [
      { label: 'Save everything', run: () => parts.files.saveEverything() },
      { label: 'Copy report', run: () => void this.copy() },
    ]);
  }

  private async copy(): Promise<void> {
    const module = await onDemand(this.parts.messages, 'The report', () => import('./fault-report.ts'));
    await module?.copyReport(this.parts, this.known);
  }
}
