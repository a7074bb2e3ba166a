namespace FractalEngine.Core.Physics.Islands;

/// <summary>Two bodies that are so near that they touch, or may meet within the step.</summary>
/// <param name="First">Index of a body that can move.</param>
/// <param name="Second">Index of the other body.</param>
/// <param name="IsSecondFirm">True where the other one sleeps or is stuck, and does not give way.</param>
/// <param name="IsTouching">True where they touch.</param>
internal record struct BodyPair(int First, int Second, bool IsSecondFirm, bool IsTouching)
{
    /// <summary>True where the pair is a contact of the present islands.</summary>
    public bool IsRow { get; set; }
}
