import type { Document } from '../model/document.ts';
import { type Change, documentIn } from './change.ts';
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
