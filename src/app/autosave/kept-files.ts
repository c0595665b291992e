/** Which opened files are in the store: each is put once, and deleted when nothing in the document comes from it. */
import type { KeptFile } from '../../io/session-store.ts';
import type { Given } from './origins.ts';

/** What a save has to do about files. Call `done` or `failed` with its outcome. */
export interface FilePlan {
  readonly puts: readonly KeptFile[];
  readonly gone: readonly number[];
  done(): void;
  failed(): void;
}

/** Like `pieces.ts`. A doomed file that is needed again, for example after undo, is put again. */
export class KeptFiles {
  private readonly states = new Map<number, 'writing' | 'stored' | 'doomed'>();

  plan(needed: ReadonlySet<Given>): FilePlan {
    const wanted = new Set([...needed].map((file) => file.id));
    const puts = this.missing(needed);
    const gone = [...this.states.keys()].filter((id) => !wanted.has(id));
    for (const { id } of puts) this.states.set(id, 'writing');
    for (const id of gone) this.states.set(id, 'doomed');
    return {
      puts,
      gone,
      done: () => {
        for (const { id } of puts) if (this.states.get(id) === 'writing') this.states.set(id, 'stored');
        for (const id of gone) if (this.states.get(id) === 'doomed') this.states.delete(id);
      },
      failed: () => {
        // It may have been stored before, and not deleted yet.
        for (const { id } of puts) if (this.states.get(id) === 'writing') this.states.set(id, 'doomed');
      },
    };
  }

  /** The files that a save would have to put. */
  missing(needed: ReadonlySet<Given>): readonly Given[] {
    return [...needed].filter(({ id }) => this.states.get(id) !== 'stored');
  }

  /** Registers a file that is in the store already. */
  adopt(id: number): void {
    this.states.set(id, 'stored');
  }

  /** The store was cleared. */
  forget(): void {
    this.states.clear();
  }
}
