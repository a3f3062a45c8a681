"""NTSC video: what becomes of an image on its way through the composite signal (book 5.2, 5.3, 5.5 and 5.6).

| module | what is in it |
| --- | --- |
| `standard` | times, lines, levels, bandwidths (eq 5.4) |
| `filters` | filters of a scan line |
| `composite`, `decoders` | RGB lines to the signal in IRE, and back by notch, low-pass or comb |
| `transmission` | an image there and back; its parts in Y, I, Q; band limits (figures 5.25–5.27) |
| `interlace` | two images as the two fields of a frame (figure 5.21) |
| `legality`, `hazards` | colours the signal cannot carry and their repair; what a picture loses |
| `cube` | the RGB cube in Y I Q, hot colours marked (figure 5.23) |
| `scopes` | waveform monitor and vectorscope |
| `black_and_white` | what a black and white set shows, and which edges it loses (eq 5.5) |
| `distribution` | faults between frame buffer and encoder (5.3) |
| `frame_buffer` | code values of a PNG |

The conversions themselves are in `illuminant.color.axes`; bars, resolving wedges (figure 5.24) and safe areas (figure
5.28) in `illuminant.display.patterns`.

Example:
    >>> import numpy as np
    >>> from illuminant.display.video import legality, transmission
    >>> image = np.zeros((6, 320, 3))
    >>> image[:, 160:] = [1.0, 1.0, 0.0]
    >>> round(float(legality.composite_range(image)[1].max()), 1)
    130.8
    >>> bool(abs(transmission.transmit(image)[3, 240] - image[3, 240]).max() < 1e-6)
    True
"""
