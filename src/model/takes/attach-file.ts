/** What a `.attach.json` says: which joints of other characters the root follows in a take. */
import type { OtherFields } from '../other-fields.ts';
import type { FlattenedFile } from './layers-file.ts';
import type { Attachment } from './take.ts';

/** The end of what files of attachments are called: `sword_cut.attach.json`. */
export const ATTACH_EXTENSION = 'attach.json';

/** An attachment as in a file: the leader by the name of its character, the joint by its name, or `#7` by index. */
export interface AttachmentRow extends Omit<Attachment, 'leaderId' | 'joint'> {
  readonly character: string;
  readonly joint: string;
}

/** The content of a `.attach.json`. */
export interface AttachFile {
  /** The file beneath. */
  readonly base: string;
  readonly flattened?: FlattenedFile;
  readonly attached: readonly AttachmentRow[];
  readonly others?: OtherFields;
}
