import type { Document } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';
import { type Change, documentIn, isChange } from './change.ts';
import type { Command } from './command.ts';

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
 * their new places. If one is refused, all are.
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
      let now = document;
      let locked = 0;
      for (const args of each) {
        const change = command.run(now, args);
        now = documentIn(change);
        if (!isChange(change)) continue;
        if (change.keys) keysOf.set(args.characterId, change.keys);
        locked += change.locked ?? 0;
      }
      return { document: now, keysOf, ...(locked > 0 && { locked }) };
    },
  };
}
