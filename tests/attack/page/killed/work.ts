/** Kinds of work during which the browser is killed. */
import type { Page } from 'playwright-core';
import type { Attempt } from '../../attack.ts';
import type { Profile } from './profile.ts';

export interface Work {
  /** For the table: `edit`. */
  readonly name: string;
  /** Runs in each page before its own scripts. */
  readonly before?: () => void;
  /** Opens what is worked on. */
  begin(profile: Profile): Promise<readonly Page[]>;
  /** Works until it is time for the kill. Returns what looks whether all of it is back. */
  run(pages: readonly Page[], profile: Profile, attempt: Attempt): Promise<Check>;
}

/** @param killedMs by the clock of this process */
export type Check = (profile: Profile, killedMs: number) => Promise<Found>;

export interface Found {
  /** With the work restored, to go on. */
  readonly pages: readonly Page[];
  /** Age of the oldest edit that was lost. */
  readonly lostMs: number;
  /** What came back in halves. */
  readonly broken?: string;
}

/** Edits that each set a larger value than the one before. */
export class Edits {
  private readonly done: { readonly value: number; readonly atMs: number }[] = [];

  note(value: number): void {
    this.done.push({ value, atMs: performance.now() });
  }

  /** @param value that came back */
  lostMs(value: number, killedMs: number): number {
    const lost = this.done.find((edit) => edit.value > value);
    return lost ? killedMs - lost.atMs : 0;
  }
}

/** Runs it again and again, with pauses in which it is stored. */
export async function forAWhile(page: Page, attempt: Attempt, edit: (i: number) => Promise<void>): Promise<void> {
  const untilMs = performance.now() + 500 + attempt.random() * 3000;
  for (let i = 1; performance.now() < untilMs; i++) {
    await edit(i);
    if (attempt.random() < 0.1) await page.waitForTimeout(attempt.below(1200));
  }
}
