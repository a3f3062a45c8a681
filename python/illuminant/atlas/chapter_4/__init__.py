"""Chapter 4, illumination models: how light is followed, and what a surface does with it."""
