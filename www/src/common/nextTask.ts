/** Resolves in a new task, so that the page answers the user before what follows. */
export const nextTask = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));
