namespace FractalEngine.Core.Scenes.Films;

/// <summary>How the way to a key of a film passes in its time.</summary>
public enum Ease
{
    /// <summary>In proportion to time, from key to key.</summary>
    Linear,

    /// <summary>From rest, faster and faster: f².</summary>
    In,

    /// <summary>Slower and slower, to rest: f·(2 − f).</summary>
    Out,

    /// <summary>From rest to rest: f²·(3 − 2f).</summary>
    InOut,

    /// <summary>Not at all: what the key before has stays, up to the time of this key.</summary>
    Hold,
}
