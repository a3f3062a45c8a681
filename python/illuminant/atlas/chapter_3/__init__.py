"""Chapter 3, perceptual response: colour and its computation."""
