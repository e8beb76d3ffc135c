// The part that is used of the types of OpenCASCADE's and rhino3dm's packages.
declare const start: (options: object) => Promise<object>;
export default start;
