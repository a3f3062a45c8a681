"""Chapter 2, the illumination process: optics of surfaces."""
