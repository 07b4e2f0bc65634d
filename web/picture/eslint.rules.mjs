// The rules for TypeScript beyond those of typescript-eslint, here and in the VS Code extension.

export const rules = {
  "@typescript-eslint/no-floating-promises": [
    "error",
    { allowForKnownSafeCalls: [{ from: "package", name: "test", package: "node:test" }] },
  ],
  eqeqeq: "error",
  curly: "error",
  "max-len": ["error", { code: 120 }],
  "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
  "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true }],
  "@typescript-eslint/explicit-function-return-type": ["error", { allowExpressions: true }],
};
