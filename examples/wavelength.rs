//! Finite elements smooth by a length: of waves as long as that half is left, whatever the mesh.
use morse_smooth::{mesh::shapes, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let operator = SmootherOptions { operator: Operator::Fem, ..Default::default() };
    let options = TikhonovOptions { epsilon: epsilon_for_wavelength(0.5)?, ..Default::default() };
    for vertices in [41, 81] {
        let mesh = shapes::grid(vertices, vertices)?; // a unit square
        let mut smoother = Smoother::new(&mesh, operator)?;
        for (wavelength, left) in [(1.0, 16.0 / 17.0), (0.5, 1.0 / 2.0), (0.25, 1.0 / 17.0)] {
            let wave = |p: &[f64]| (std::f64::consts::TAU * p[0] / wavelength).cos();
            let field: Vec<f64> = mesh.positions().chunks_exact(3).map(wave).collect();
            let smoothed = smoother.tikhonov(&field, &options)?.values;
            assert!(field.iter().zip(&smoothed).all(|(f, x)| (x - left * f).abs() < 0.03));
        }
    }
    Ok(())
}
