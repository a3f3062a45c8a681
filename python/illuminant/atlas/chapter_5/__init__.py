"""Chapter 5, image display: from colours to a screen."""
