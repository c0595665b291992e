/** Names the files that belong together; looked up by base name among the given files. */
export interface Rig {
  readonly name: string;
  readonly skeleton?: string;
  readonly skin?: string;
  readonly morphs: readonly string[];
  readonly animation?: string;
}
