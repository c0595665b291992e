/** The joint that is highlighted, under the pointer or named by a row of a list; and who is told when it changes. */
import type { JointRef } from '../skeleton/drawn-skeletons.ts';

export class Highlight {
  private current: JointRef | undefined;
  private readonly listeners = new Set<() => void>();

  get joint(): JointRef | undefined {
    return this.current;
  }

  set(joint: JointRef | undefined): void {
    this.current = joint;
    for (const listener of this.listeners) listener();
  }

  /** Calls back when another joint or none is highlighted. Returns an unsubscribe function. */
  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}
