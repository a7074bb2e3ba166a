using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>Maps keys to commands of the physics: pausing, dropping spheres, walking and showing contacts.</summary>
internal static class PhysicsKeys
{
    /// <summary>Runs the command of a key.</summary>
    /// <returns>A message for the user; null for keys without a command.</returns>
    public static string? Apply(Document document, Key key)
    {
        var physics = document.Physics;
        switch (key)
        {
            case Key.Space when !physics.IsWalking || physics.IsPaused:
                return physics.TogglePause();
            case Key.N:
                return physics.StepOnce();
            case Key.R:
                return physics.Reset();
            case Key.B:
                return document.VisibleDepth > 0
                    ? "a ball is too large for this depth: zoom out first"
                    : physics.DropSphere(document.Camera);
            case Key.C:
                return physics.SwitchCollider();
            case Key.P:
                return document.ToggleWalking();
            case Key.V:
                physics.ShowsClosestPoints = !physics.ShowsClosestPoints;
                return physics.ShowsClosestPoints ? "closest points and normals: shown" : "closest points and normals: hidden";
            default:
                return null;
        }
    }
}
