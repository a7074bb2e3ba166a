namespace FractalEngine.Core.Physics.Events;

/// <summary>What has become of a contact in a step.</summary>
public enum ContactPhase
{
    /// <summary>The two did not touch before the step, and have touched in it.</summary>
    Begin,

    /// <summary>The two have touched in the step before as well.</summary>
    Stay,

    /// <summary>The two touched in the step before, and have not in this one.</summary>
    End,
}
