/** Shows another page: its id is that of a route. */
export const go = (id: string): void => void (location.hash = `#/${id}`);
