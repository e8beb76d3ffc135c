// What is used of an optional peer's types.
declare const start: (options: object) => Promise<object>;
export default start;
