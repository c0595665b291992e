/** What `NAME.layers.json` says: the layers of the take `NAME`, with their files by name. */
import type { OtherFields } from '../other-fields.ts';
import type { LayerSettings } from './take.ts';

/** The end of what files of layers are called: `walk.layers.json`. */
export const LAYERS_EXTENSION = 'layers.json';

/** The plain file beside a JSON, as it was saved with it. */
export interface FlattenedFile {
  readonly file: string;
  /** 64 hex digits. */
  readonly sha256: string;
  readonly others?: OtherFields;
}

/** A layer with the name of its file. */
export interface LayerRow extends LayerSettings {
  readonly file: string;
}

/** The content of a `.layers.json`. */
export interface LayersFile {
  readonly base: string;
  readonly flattened?: FlattenedFile;
  readonly layers: readonly LayerRow[];
  readonly others?: OtherFields;
}
