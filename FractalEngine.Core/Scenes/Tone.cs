namespace FractalEngine.Core.Scenes;

/// <summary>How the linear light of an image becomes what a screen can show.</summary>
public enum Tone
{
    /// <summary>Light up to 1 is shown as it is; what is brighter is white.</summary>
    None,

    /// <summary>A curve with a soft shoulder and a dark toe, as film has: bright light loses its colour gradually.</summary>
    Filmic,

    /// <summary>A curve of luminance that keeps the hue, and shows a luminance of 4 as 1.</summary>
    Reinhard,

    /// <summary>The Academy's reference rendering, in which bright light pales and colours mix as in film.</summary>
    Aces,
}
