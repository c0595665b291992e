/** Which arguments a command takes from scripts. The compiler compares each shape with the type of the command. */
import type { Document } from '../../model/document.ts';
import { type Command, CommandError, type Edit } from '../store.ts';
import { type Fields, record, type Shape, type Shapes } from './shape.ts';

/** A command with the shape of its arguments. */
export interface Taking {
  readonly command: Command<never, Document | Edit>;
  readonly fields: Fields;
  readonly shape: Shape<object>;
}

/** Fields that give arguments of type A, and leave none of them out. */
type FieldsOf<A, F extends Fields> =
  Shapes<F> extends A ? (Exclude<keyof A, keyof F> extends never ? F : never) : never;

export function takes<A, const F extends Fields>(
  command: Command<A, Document | Edit>,
  fields: F & FieldsOf<A, F>,
): Taking {
  return { command, fields, shape: record(fields) };
}

/** @param why it can't be run by scripts, and what can */
export function notFromScripts<A>(command: Command<A, Document | Edit>, why: string): Taking {
  const refusal = `Scripts can’t run this: ${why}.`;
  const read = () => {
    throw new CommandError(refusal);
  };
  return { command, fields: {}, shape: { what: refusal, read } };
}
