/** What the row above the text says: that the text isn't what is in the page, or what of it was changed there. */
import type { TextState } from './as-opened.ts';
import { changesInWords } from './change-bar.ts';
import type { TextChanges } from './text-changes.ts';

export interface Note {
  /** Empty: nothing. */
  readonly text: string;
  /** Whether changes are shown; absent: there can be none. */
  readonly isOn?: boolean;
  /** Whether there are changes to go to. */
  readonly hasSteps?: boolean;
}

/** What is known of a text. */
export interface Noted {
  readonly state: TextState;
  readonly isEdited: boolean;
  /** Whether edits of it were left. */
  readonly hasDraft: boolean;
  readonly hasErrors: boolean;
  readonly showsChanges: boolean;
  readonly changes: Pick<TextChanges, 'text' | 'problem' | 'isComparing'>;
}

const AS_IT_CAME = 'line numbers are those of the original file.';

export function noteOf({ state, isEdited, hasDraft, hasErrors, showsChanges, changes }: Noted): Note {
  // The field says itself what is edited.
  if (isEdited) return { text: '' };
  if (hasDraft) return { text: 'Edits of this text were not applied. Edit shows them again.' };
  if (state === 'same') return { text: '' };
  if (state === 'other') return { text: otherNote(hasErrors) };
  if (!showsChanges) return { text: `Edited since it was opened: ${AS_IT_CAME}`, isOn: false };
  const { text, problem, isComparing } = changes;
  if (text) {
    const said = `${changesInWords(text.hunks)} since it was opened. Click one to see what it was.`;
    return { text: said, isOn: true, hasSteps: true };
  }
  if (problem !== undefined && !isComparing) return { text: `${problem} ${capital(AS_IT_CAME)}` };
  return { text: 'Edited since it was opened. Comparing…', isOn: true };
}

function otherNote(hasErrors: boolean): string {
  const why = hasErrors ? 'This text has errors and was not opened' : 'This text is not the version that is open';
  const how = hasErrors ? ' Edit corrects it here.' : '';
  return `${why}. The page has another version, so no lines are highlighted.${how}`;
}

const capital = (text: string) => text[0].toUpperCase() + text.slice(1);
