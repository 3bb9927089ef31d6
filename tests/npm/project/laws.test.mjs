import test from "node:test";
import {laws} from "liecheck/test";

for (const law of laws("./adapter.mjs")) test(law.name, law.run);
