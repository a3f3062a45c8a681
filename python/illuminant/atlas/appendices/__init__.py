"""The appendices: surface properties from data (II), the book's functions (III), form factors (IV)."""
