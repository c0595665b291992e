/**
 * Names cut for the labels of undo steps: in the middle, since long ones often differ only at the end. Apart from
 * `step-names.ts`, since opening a file needs no more.
 */

/** Length of a name that shares the label with a few words. */
const NAME_LENGTH = 24;
/** Length of one of two names in a label, or beside many words. */
export const SHORT_NAME = 16;

/** The name, or its start and end around an ellipsis. */
export function cutName(name: string, length = NAME_LENGTH): string {
  if (name.length <= length) return name;
  const end = Math.floor((length - 1) / 2);
  return `${name.slice(0, length - 1 - end)}…${name.slice(-end)}`;
}
