/**
 * Fields of a JSON file that are not known here: plain data, kept with what they belong to and written back after its
 * own fields, so that another version's file loses nothing.
 */
export type OtherFields = Readonly<Record<string, unknown>>;
