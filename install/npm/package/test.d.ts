/** A law in one scalar, as a case of a test runner. */
export interface Law {
  name: string;
  law: string;
  scalar: "double" | "float";
  /**
   * Resolves if the library fulfils the law. Otherwise the message of the error is what `liecheck test` prints. Given
   * the context of node:test, it marks a failure that a limits file expects as `todo`.
   */
  run(...context: unknown[]): Promise<void>;
}
/** Flags of `liecheck test`: {cases: 500, "no-probe": true}. 1000 cases and seed 42 if they are not given. */
export type Flags = {[flag: string]: string | number | true | (string | number)[]};
/**
 * A case for each law and scalar of which the adapter offers an operation. adapter: a path from the working folder, or
 * a URL.
 */
export function laws(adapter: string | URL, options?: Flags): Law[];
