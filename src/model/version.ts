/** The version of the program, that of package.json: a test compares them. */
export const VERSION = '1.0.0';
