/**
 * Parses `tx ry`: the DOFs of a compound joint.
 *
 * @param choices allowed names, each at most once
 * @returns the list, or what is wrong with it
 */
export function typedList(text: string, choices: readonly string[]): readonly string[] | string {
  const words = text
    .toLowerCase()
    .split(/[\s,]+/)
    .filter(Boolean);
  const list: string[] = [];
  for (const word of words) {
    if (!choices.includes(word)) return `“${word.slice(0, 12)}” is not one of ${choices.join(' ')}.`;
    if (list.includes(word)) return `${word} is listed twice. A compound joint can have each DOF only once.`;
    list.push(word);
  }
  return list.length ? list : 'A compound joint needs at least one DOF. Nothing was changed.';
}
