import type { Document } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';
import { type Change, documentIn, isChange } from './change.ts';
import type { Command } from './command.ts';
import { AllLockedError } from './pose/locks.ts';

/**
 * A command for several of what it changes one of, as one step. The selection stays; if one is refused, all are.
 *
 * @param label of the step
 */
export function inTurn<Args>(command: Command<Args, Document | Change>, label: string): Command<readonly Args[]> {
  return {
    id: command.id,
    label: (document, [first, ...others]) =>
      first !== undefined && others.length === 0 ? command.label(document, first) : label,
    run: (document, each) => each.reduce((before, args) => documentIn(command.run(before, args)), document),
  };
}

/**
 * A command on keys of one character for those of several, as one step: afterwards each character's are selected at
 * their new places. If one is refused, all are; but one of which all that would change is locked is left alone.
 *
 * @param label of the step, unless it is for one
 */
export function onEachCharacter<Args extends { readonly characterId: string }>(
  command: Command<Args, Document | Change>,
  label: string,
): Command<readonly Args[], Change> {
  return {
    ...inTurn(command, label),
    run(document, each) {
      const keysOf = new Map<string, readonly ChannelKeys[]>();
      let all: Change = { document };
      let lockedOnes = 0;
      for (const args of each) {
        const change = lockedOr(() => command.run(all.document, args));
        if (change instanceof AllLockedError) {
          all = { document: all.document, ...leftAlone(all, { locked: change.count }) };
          if (++lockedOnes === each.length) throw new AllLockedError(all.locked ?? 0);
          continue;
        }
        const told: Partial<Change> = isChange(change) ? change : {};
        all = { ...told, document: documentIn(change), ...leftAlone(all, told) };
        if (all.keys) keysOf.set(args.characterId, all.keys);
      }
      // What one says of itself isn't said of all.
      return each.length === 1 ? { ...all, keysOf } : { document: all.document, keysOf, ...leftAlone(all) };
    },
  };
}

function lockedOr<T>(run: () => T): T | AllLockedError {
  try {
    return run();
  } catch (error) {
    if (error instanceof AllLockedError) return error;
    throw error;
  }
}

/** The numbers of what both have left alone. */
function leftAlone(a: Partial<Change>, b: Partial<Change> = {}): Pick<Change, 'locked' | 'switches'> {
  const locked = (a.locked ?? 0) + (b.locked ?? 0);
  const switches = (a.switches ?? 0) + (b.switches ?? 0);
  return { ...(locked > 0 && { locked }), ...(switches > 0 && { switches }) };
}
